// Small files on which the bench once failed; they lie beside the project and are skipped where they do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "harness/base/error.h"
#include "harness/camera/view_probe.h"
#include "harness/gltf/gltf.h"
#include "harness/lights/set.h"
#include "harness/scene/scene.h"

namespace ml {
namespace {

std::filesystem::path case_file(const std::string& name) {
  const char* shared = std::getenv("MANYLIGHTS_SHARED");
  return std::filesystem::path(shared ? shared : ML_SOURCE_DIR "/../shared") / "cases" / name;
}

#define LOAD_CASE(scene, name)                                                                       \
  if (!std::filesystem::exists(case_file(name))) GTEST_SKIP() << case_file(name) << " is not there"; \
  const Scene scene = import_gltf(case_file(name), -1, 1, glm::dvec3(0))

LightSet own_lights(const Scene& scene) {
  LightSpec spec;
  spec.placement = Placement::gltf;
  spec.auto_count = true;
  return {spec, scene};
}

bool noted(const Scene& scene, const std::string& part) {
  return std::any_of(scene.notes.begin(), scene.notes.end(),
                     [&](const std::string& note) { return note.find(part) != note.npos; });
}

Projection first_window(const Scene& scene) {
  return scene.paths[0].sample(0, 1, 240, 135, scene.near, scene.far).projection;
}

TEST(SharedCases, AllLightsOfAFile) {
  LOAD_CASE(scene, "lights537.glb");
  EXPECT_EQ(own_lights(scene).account().used, 537u);
}

TEST(SharedCases, LightsWithoutRange) {
  for (const char* name : {"norange_above6.glb", "norange_above3.glb"}) {
    LOAD_CASE(scene, name);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_FLOAT_EQ(scene.lights[0].radius, 10 * std::sqrt(1000.0f)) << name;
  }
}

TEST(SharedCases, LightsThatCannotBeUsed) {
  LOAD_CASE(inverted, "cone_inv.glb");
  const LightAccount cones = own_lights(inverted).account();
  EXPECT_EQ(cones.used, 1u);
  EXPECT_EQ(cones.rejections.at("inner cone angle is above the outer"), 4u);
  LOAD_CASE(scene, "norange.glb");
  const LightAccount account = own_lights(scene).account();
  EXPECT_EQ(account.total, 6u);
  EXPECT_EQ(account.dark, 3u);
  EXPECT_EQ(account.rejections.count("radius is above 1e12 m"), 0u);
  EXPECT_EQ(account.used + account.dark + account.rejected(), 6u);
}

TEST(SharedCases, EveryInstanceOfAMeshIsThere) {
  LOAD_CASE(scene, "inst_opt.glb");
  // A floor, nine pillars, and a hundred boxes.
  EXPECT_EQ(scene.triangle_count(), 2u + 9 * 12 + 100 * 12);
}

TEST(SharedCases, ASkinStandsByItsJoints) {
  LOAD_CASE(scene, "skin_cm.glb");
  float top = 0;
  for (const Draw& draw : scene.draws)
    if (draw.material == 1)
      for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; ++i)
        top = std::max(top, scene.vertices[scene.indices[i]].position.y + static_cast<float>(scene.origin.y));
  EXPECT_NEAR(top, 1.8f, 1e-5f);
  EXPECT_LT(scene.bounds.size().y, 10);
}

TEST(SharedCases, ARootThatIsAChildIsDrawnOnce) {
  LOAD_CASE(scene, "root_is_child.glb");
  EXPECT_EQ(scene.triangle_count(), 2u + 9 * 12);
  EXPECT_TRUE(noted(scene, "1 nodes that the scene lists lie below others"));
}

TEST(SharedCases, TexturesThatCannotBeReadAreWhite) {
  for (const char* name : {"img_missing.glb", "img_tga.glb", "up/levels/l.glb"}) {
    LOAD_CASE(scene, name);
    EXPECT_TRUE(scene.textures.empty()) << name;
    EXPECT_TRUE(noted(scene, "1 images cannot be read, and are drawn white")) << name;
  }
  const Scene whole = import_gltf(case_file("up/levels/l.glb"), -1, 1, glm::dvec3(0), case_file("up"));
  EXPECT_EQ(whole.textures.size(), 1u);
}

TEST(SharedCases, SamplersAreAsTheFileHasThem) {
  LOAD_CASE(scene, "nearest_sampler.glb");
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].sampler, (Sampler{.magnify = Filter::nearest, .minify = Filter::nearest}));
}

TEST(SharedCases, AnOlderFormatIsNamed) {
  if (!std::filesystem::exists(case_file("gltf10.gltf"))) GTEST_SKIP() << "gltf10.gltf is not there";
  try {
    import_gltf(case_file("gltf10.gltf"), -1, 1, glm::dvec3(0));
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("the file is glTF 1.0, but 2.0 is needed"), std::string::npos);
  }
}

TEST(SharedCases, ASunIsNamed) {
  LOAD_CASE(scene, "sun.glb");
  EXPECT_TRUE(noted(scene, "1 directional light (a sun) is not used"));
  EXPECT_THROW(own_lights(scene), UsageError);
}

TEST(SharedCases, NearAndFarPlanes) {
  LOAD_CASE(tiny, "tiny_level.glb");
  EXPECT_EQ(first_window(tiny).near, 1e-5f);
  LOAD_CASE(cut, "perspective_zfar8.glb");
  EXPECT_EQ(first_window(cut).far, 8.0f);
  EXPECT_TRUE(first_window(cut).clips_far);
  EXPECT_TRUE(noted(cut, "zfar of 8 m"));
  LOAD_CASE(wide, "ortho_far1e8.glb");
  LOAD_CASE(narrow, "ortho_far1e3.glb");
  EXPECT_EQ(first_window(wide).far, first_window(narrow).far);
  EXPECT_LT(first_window(wide).far, 100);
}

TEST(SharedCases, CamerasHaveTheirRoll) {
  LOAD_CASE(down, "cam_down90.glb");
  const Camera camera = down.paths[0].sample(0, 1, 240, 135, 0.1f, 100);
  EXPECT_LT(glm::length(camera.forward - glm::vec3(0, -1, 0)), 1e-6f);
  // The file's rotation (-0.5, 0.5, 0.5, 0.5) takes y to (-1, 0, 0).
  EXPECT_LT(glm::length(camera.up - glm::vec3(-1, 0, 0)), 1e-6f);
}

TEST(SharedCases, StepsAreCuts) {
  LOAD_CASE(scene, "step_cuts.glb");
  const CameraPath& path = scene.paths[0];
  uint32_t cuts = 0, views = 1;
  for (uint32_t frame = 1; frame < 121; ++frame) {
    const Camera before = path.sample(frame - 1, 121, 240, 135, 0.1f, 100),
                 here = path.sample(frame, 121, 240, 135, 0.1f, 100);
    const bool same =
        before.position == here.position && before.forward == here.forward && before.up == here.up;
    EXPECT_EQ(path.cuts(frame, 121), !same) << frame;
    cuts += path.cuts(frame, 121);
    views += !same;
  }
  EXPECT_EQ(views, cuts + 1);
  EXPECT_GE(cuts, 1u);
  EXPECT_LE(cuts, 5u);
}

TEST(SharedCases, AnimatedLightsMove) {
  LOAD_CASE(scene, "anim_light.glb");
  const LightSet set = own_lights(scene);
  std::vector<Light> first, last;
  set.at(0, 8, scene.paths[0].duration(), first);
  set.at(5, 8, scene.paths[0].duration(), last);
  ASSERT_EQ(first.size(), last.size());
  double moved = 0;
  for (size_t i = 0; i < first.size(); ++i) moved += glm::length(first[i].position - last[i].position);
  EXPECT_GT(moved, 0.5);
}

TEST(SharedCases, AutomaticPathsSeeSurfaces) {
  for (const char* name : {"cube2m.glb", "tiny_level_nocam.glb", "nocam.glb"}) {
    LOAD_CASE(scene, name);
    const RayCaster rays(scene);
    const ViewProbe probe(scene, rays);
    for (uint32_t frame = 0; frame < 40; ++frame)
      EXPECT_GT(probe.seen(scene.paths[0].sample(frame, 40, 240, 135, scene.near, scene.far), 48, 27), 0.04)
          << name << " " << frame;
  }
}

TEST(SharedCases, NamesOfCamerasCanBeTyped) {
  LOAD_CASE(scene, "dupnames.glb");
  EXPECT_NO_THROW(scene.path("Camera-2"));
  EXPECT_NO_THROW(scene.path("\u041a\u0430\u043c_\u0435\u0440\u0430/\u00fc"));
}

}  // namespace
}  // namespace ml
