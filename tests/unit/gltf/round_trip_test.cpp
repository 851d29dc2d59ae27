// What export_glb writes, import_gltf reads back.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/base/random.h"
#include "harness/gltf/gltf.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

namespace fs = std::filesystem;

class GltfRoundTrip : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("manylights-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
               std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file() const { return folder_ / "level.glb"; }
  Scene there_and_back(const Scene& scene, const std::vector<Light>& lights = {}) const {
    export_glb(scene, lights, file());
    return import_gltf(file(), -1, 1, glm::dvec3(0));
  }

  fs::path folder_;
};

// Random triangles with three materials, one of them textured, far from the world's zero, with a moving
// camera.
Scene busy_scene() {
  Random random(7);
  Scene scene;
  scene.name = "busy";
  scene.origin = {1e6, -20, 12345};
  scene.near = 0.25f, scene.far = 333;
  for (uint32_t i = 0; i < 300; ++i) {
    glm::vec3 position(random.uniform(-50, 50), random.uniform(0, 20), random.uniform(-70, 70));
    glm::vec3 normal =
        glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(0.1f, 1), random.uniform(-1, 1)));
    scene.vertices.push_back({position, normal, {random.uniform(-3, 3), random.uniform()}});
    scene.indices.push_back(random.below(300));
  }
  scene.draws = {{0, 90, 0}, {90, 120, 1}, {210, 90, 2}};
  scene.materials = {
      {.name = "stone", .base_color = {0.1f, 0.2f, 0.3f, 1}, .metallic = 0.5f, .roughness = 0.25f},
      {.name = "leaf",
       .base_color_texture = 0,
       .alpha_mode = AlphaMode::mask,
       .alpha_cutoff = 0.3f,
       .double_sided = true},
      {.name = "wood", .forward = true}};
  Texture texture{.name = "leaf", .width = 5, .height = 3, .rgba = {}};
  for (int i = 0; i < 5 * 3 * 4; ++i) texture.rgba.push_back(static_cast<uint8_t>(random.next()));
  scene.textures.push_back(texture);
  CameraPath path;
  path.name = "default";
  path.vertical_fov = 0.9f;
  path.keys = {{0, {0, 2, 0}, {5, 2, 0}},
               {3, {10, 4, 2}, {12, 3, 40}},
               {4.5, {20, 3, 15}, {0, 9, 0}},
               {9, {0, 8, 30}, {1, 2, 3}}};
  scene.paths.push_back(path);
  scene.bounds = {scene.vertices[0].position, scene.vertices[0].position};
  for (const Vertex& v : scene.vertices)
    scene.bounds.min = glm::min(scene.bounds.min, v.position),
    scene.bounds.max = glm::max(scene.bounds.max, v.position);
  return scene;
}

std::vector<Light> many_lights(uint32_t count) {
  Random random(count);
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    light.position = {double{random.uniform(-50, 50)} / 3, double{random.uniform(0, 20)},
                      double{random.uniform(-70, 70)}};
    light.radius = random.uniform(0.1f, 30);
    light.intensity = {random.uniform(0, 100), random.uniform(0, 1e-3f), random.uniform(0, 1)};
    light.shape = static_cast<LightShape>(random.below(5));
    auto any = [&] {
      return glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    };
    light.direction = any();
    light.side = glm::normalize(glm::cross(light.direction, any()));
    if (has_segment(light.shape)) light.half_length = random.below(4) ? random.uniform(0, 9) : 0;
    if (light.shape == LightShape::box)
      make_box(light, {random.uniform(0.01f, 5), random.uniform(0.01f, 5), random.uniform(0.01f, 5)});
    light.outer_angle = random.uniform(0.01f, 3.14f);
    light.probe = random.below(4) == 0;
    light.inner_angle = random.below(4) == 0 ? light.outer_angle : light.outer_angle * random.uniform();
  }
  return lights;
}

void expect_same_lights(const std::vector<Light>& a, const std::vector<Light>& b, float direction_tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position) << i;
    EXPECT_EQ(a[i].radius, b[i].radius) << i;
    EXPECT_EQ(a[i].intensity, b[i].intensity) << i;
    EXPECT_EQ(a[i].shape, b[i].shape) << i;
    EXPECT_EQ(a[i].probe, b[i].probe) << i;
    EXPECT_EQ(a[i].half_length, b[i].half_length) << i;
    EXPECT_EQ(a[i].half_extents, b[i].half_extents) << i;
    if (has_cone(a[i].shape)) {
      EXPECT_EQ(a[i].inner_angle, b[i].inner_angle) << i;
      EXPECT_EQ(a[i].outer_angle, b[i].outer_angle) << i;
    }
    if (has_cone(a[i].shape) || a[i].shape == LightShape::box) {
      EXPECT_LE(glm::length(a[i].direction - b[i].direction), direction_tolerance) << i;
    }
    if (has_segment(a[i].shape) || a[i].shape == LightShape::box) {
      EXPECT_LE(glm::length(a[i].side - b[i].side), direction_tolerance) << i;
    }
  }
}

TEST_F(GltfRoundTrip, GeometryKeepsItsBits) {
  Scene before = busy_scene(), after = there_and_back(before);
  ASSERT_EQ(after.vertices.size(), before.vertices.size());
  for (size_t i = 0; i < before.vertices.size(); ++i) {
    EXPECT_EQ(after.vertices[i].position, before.vertices[i].position);
    EXPECT_EQ(after.vertices[i].normal, before.vertices[i].normal);
    EXPECT_EQ(after.vertices[i].uv, before.vertices[i].uv);
  }
  EXPECT_EQ(after.indices, before.indices);
  ASSERT_EQ(after.draws.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.draws[i].first_index, before.draws[i].first_index);
    EXPECT_EQ(after.draws[i].index_count, before.draws[i].index_count);
    EXPECT_EQ(after.draws[i].material, before.draws[i].material);
  }
}

TEST_F(GltfRoundTrip, NamePlanesAndOriginStay) {
  Scene before = busy_scene(), after = there_and_back(before);
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.origin, before.origin);
  EXPECT_EQ(after.near, before.near);
  EXPECT_EQ(after.far, before.far);
  EXPECT_EQ(after.bounds.min, before.bounds.min);
  EXPECT_EQ(after.bounds.max, before.bounds.max);
  EXPECT_TRUE(after.notes.empty());
}

TEST_F(GltfRoundTrip, MaterialsAndTexturesStay) {
  Scene before = busy_scene(), after = there_and_back(before);
  ASSERT_EQ(after.materials.size(), before.materials.size());
  for (size_t i = 0; i < before.materials.size(); ++i) {
    const Material &a = after.materials[i], &b = before.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.base_color_texture, b.base_color_texture);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.roughness, b.roughness);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.alpha_mode == AlphaMode::mask ? a.alpha_cutoff : b.alpha_cutoff, b.alpha_cutoff);
    EXPECT_EQ(a.double_sided, b.double_sided);
    EXPECT_EQ(a.forward, b.forward);
  }
  ASSERT_EQ(after.textures.size(), 1u);
  EXPECT_EQ(after.textures[0].name, "leaf");
  EXPECT_EQ(after.textures[0].width, 5u);
  EXPECT_EQ(after.textures[0].rgba, before.textures[0].rgba);
}

TEST_F(GltfRoundTrip, TheMovingCameraLooksAtTheSame) {
  Scene before = busy_scene(), after = there_and_back(before);
  ASSERT_EQ(after.paths.size(), 1u);
  EXPECT_EQ(after.paths[0].name, "default");
  EXPECT_EQ(after.paths[0].vertical_fov, before.paths[0].vertical_fov);
  EXPECT_NEAR(after.paths[0].duration(), before.paths[0].duration(), 1e-5);
  for (uint32_t frame = 0; frame < 100; ++frame) {
    Camera a = before.paths[0].sample(frame, 100, 320, 180, 0.1f, 100),
           b = after.paths[0].sample(frame, 100, 320, 180, 0.1f, 100);
    EXPECT_LT(glm::length(a.position - b.position), 2e-3f) << frame;
    EXPECT_LT(glm::length(a.forward - b.forward), 2e-3f) << frame;
    EXPECT_LT(glm::length(a.up - b.up), 2e-3f) << frame;
  }
}

TEST_F(GltfRoundTrip, AStillCameraStaysStill) {
  Scene before = busy_scene();
  before.paths[0].keys.resize(1);
  Scene after = there_and_back(before);
  ASSERT_EQ(after.paths[0].keys.size(), 1u);
  Camera a = before.paths[0].sample(0, 1, 320, 180, 0.1f, 100),
         b = after.paths[0].sample(0, 1, 320, 180, 0.1f, 100);
  EXPECT_EQ(a.position, b.position);
  EXPECT_LT(glm::length(a.forward - b.forward), 1e-6f);
}

TEST_F(GltfRoundTrip, ProjectionsStay) {
  Scene before = busy_scene();
  CameraPath& path = before.paths[0];
  path.has_projection = true;
  for (ProjectionKind kind : {ProjectionKind::perspective, ProjectionKind::orthographic})
    for (float shift : {0.0f, 0.25f}) {
      path.projection = {.kind = kind,
                         .left = -2 + shift,
                         .right = 2,
                         .bottom = -1,
                         .top = 1 + shift,
                         .near = 0.5f,
                         .far = 50};
      Scene after = there_and_back(before);
      ASSERT_TRUE(after.paths[0].has_projection);
      const Projection& found = after.paths[0].projection;
      EXPECT_EQ(found.kind, kind);
      EXPECT_EQ(found.left, path.projection.left);
      EXPECT_EQ(found.right, path.projection.right);
      EXPECT_EQ(found.bottom, path.projection.bottom);
      EXPECT_EQ(found.top, path.projection.top);
      EXPECT_EQ(found.near, path.projection.near);
      EXPECT_EQ(found.far, path.projection.far);
    }
}

TEST_F(GltfRoundTrip, LightsInTheFile) {
  for (uint32_t count : {0u, 1u, 4096u}) {
    std::vector<Light> lights = many_lights(count);
    expect_same_lights(there_and_back(busy_scene(), lights).lights, lights, 1e-6f);
    EXPECT_FALSE(fs::exists(file().string() + ".lights.bin"));
  }
}

TEST_F(GltfRoundTrip, LightsInTheSideFileKeepTheirBits) {
  std::vector<Light> lights = many_lights(4097);
  expect_same_lights(there_and_back(busy_scene(), lights).lights, lights, 0);
  EXPECT_EQ(fs::file_size(file().string() + ".lights.bin"), 16u + 92u * 4097u);
}

TEST_F(GltfRoundTrip, EveryNameThatCanBeWrittenCanBeReadBack) {
  const std::vector<Light> lights = many_lights(4097);
  const fs::path folder = file().string() + "-names";
  fs::create_directories(folder);
  for (const char* name :
       {"a%20b.glb", "a b.glb", "a#b?c.glb", "100%.glb", "%.glb", "a:b.glb", "a\\b.glb",
        "\xc3\xbc \xd0\x9a.glb", "\xff.glb", "a\tb\"'.glb", "..glb", "data:;base64,a.glb"}) {
    export_glb(busy_scene(), lights, folder / name);
    EXPECT_EQ(import_gltf(folder / name, -1, 1, glm::dvec3(0)).lights.size(), 4097u) << name;
  }
  fs::remove_all(folder);
}

TEST_F(GltfRoundTrip, SideFileErrorsNameTheFile) {
  fs::path side = file().string() + ".lights.bin";
  export_glb(busy_scene(), many_lights(4097), file());
  auto message = [&]() -> std::string {
    try {
      import_gltf(file(), -1, 1, glm::dvec3(0));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "accepted";
  };
  std::string good = read_text_file(side);
  auto with = [&](std::string bytes) {
    write_file(side, bytes);
    return message();
  };
  EXPECT_EQ(with(good.substr(0, good.size() - 1)),
            side.string() + ": header: 4097 lights take 376940 bytes, but the file has 376939");
  EXPECT_EQ(with("MLLIGHT"), side.string() + ": not a light file: it does not begin with 'MLLIGHTS'");
  std::string bad = good;
  bad[8] = 3;
  EXPECT_EQ(with(bad), side.string() + ": header: expected version 1 or 2, found 3");
  bad = good;
  bad[15] = 1;
  EXPECT_EQ(with(bad), side.string() + ": header: 16781313 lights, more than 1048576");
  bad = good;
  bad[16 + 92 + 60] = 7;
  EXPECT_EQ(with(bad), side.string() + ": lights[1]: shape 7, expected 0 to 4");
  fs::remove(side);
  EXPECT_EQ(message(),
            file().string() + ": asset.extras.manylights.lights: " + side.string() + ": no such file");
  // From memory there is no folder to look in.
  try {
    GltfTestFile::load_bytes(read_text_file(file()));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "test.glb: asset.extras.manylights.lights: external files are refused here: 'level.glb.lights.bin'");
  }
}

TEST_F(GltfRoundTrip, SideFilesOfVersionOneAreRead) {
  // Version 1 had 64 bytes a light, up to its shape, no shapes but omni and spot, and no probe lights.
  std::vector<Light> lights = many_lights(4097);
  for (Light& light : lights) {
    if (static_cast<uint32_t>(light.shape) > 1) light.shape = LightShape::spot;
    light.half_length = 0, light.half_extents = glm::vec3(0), light.side = {1, 0, 0}, light.probe = false;
  }
  export_glb(busy_scene(), lights, file());
  const fs::path side = file().string() + ".lights.bin";
  const std::string now = read_text_file(side);
  std::string old = now.substr(0, 16);
  old[8] = 1;
  for (size_t i = 0; i < lights.size(); ++i) old += now.substr(16 + 92 * i, 64);
  write_file(side, old);
  expect_same_lights(import_gltf(file(), -1, 1, glm::dvec3(0)).lights, lights, 0);
  old[16 + 60] = 2;
  write_file(side, old);
  try {
    import_gltf(file(), -1, 1, glm::dvec3(0));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.what(), side.string() + ": lights[0]: shape 2, expected 0 to 1");
  }
}

TEST_F(GltfRoundTrip, TheSameSceneGivesTheSameBytes) {
  export_glb(busy_scene(), many_lights(50), file());
  std::string first = read_text_file(file());
  export_glb(busy_scene(), many_lights(50), file());
  EXPECT_EQ(first, read_text_file(file()));
}

TEST_F(GltfRoundTrip, ASecondRoundTripChangesNoByte) {
  // What a quaternion can only approximate is left out: spots, and a camera that does not look along an axis.
  Scene scene = busy_scene();
  scene.paths[0].keys = {{0, {1, 2, 3}, {1, 2, -8}}};
  std::vector<Light> lights = many_lights(50);
  for (Light& light : lights) light.shape = LightShape::omni;
  Scene again = there_and_back(scene, lights);
  std::string first = read_text_file(file());
  export_glb(again, again.lights, file());
  EXPECT_EQ(first, read_text_file(file()));
}

TEST_F(GltfRoundTrip, NothingUnusedIsWritten) {
  Scene scene = busy_scene();
  scene.draws.resize(1);  // the textured material and the third one are not drawn
  Scene after = there_and_back(scene);
  EXPECT_EQ(after.materials.size(), 1u);
  EXPECT_TRUE(after.textures.empty());
  for (const Vertex& vertex : after.vertices) EXPECT_EQ(vertex.uv, glm::vec2(0));
}

TEST_F(GltfRoundTrip, WhatCannotBeExportedIsAnError) {
  std::vector<Light> lights = many_lights(3);
  lights[2].radius = 0;
  EXPECT_THROW(export_glb(busy_scene(), lights, file()), UsageError);
  EXPECT_THROW(export_glb(Scene{}, {}, file()), UsageError);
  EXPECT_THROW(export_glb(busy_scene(), {}, folder_ / "missing" / "level.glb"), SystemError);
  EXPECT_FALSE(fs::exists(file()));
}

}  // namespace
}  // namespace ml
