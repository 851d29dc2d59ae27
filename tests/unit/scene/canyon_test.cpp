#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

#include "depth_probe.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/scene/canyon_parts.h"
#include "harness/scene/light_set.h"
#include "harness/scene/procedural.h"

namespace ml {
namespace {

constexpr uint32_t kCiFrames = 120;

const Scene& canyon() {
  static const Scene scene = make_canyon(1);
  return scene;
}

DepthProbe see(const Scene& scene, const RayCaster& rays, double seconds) {
  auto frame = static_cast<uint32_t>(seconds * 60);
  return probe(rays, scene.paths[0].sample(frame, 2401, 64, 36, scene.near, scene.far));
}

uint32_t hash_of(const Scene& scene) {
  uint32_t hash = 0;
  for (const Vertex& v : scene.vertices) {
    std::array<uint32_t, 8> words;
    std::memcpy(words.data(), &v, sizeof v);
    for (uint32_t word : words) hash = hash_u32(hash, word);
  }
  for (uint32_t index : scene.indices) hash = hash_u32(hash, index);
  for (const CameraKey& key : scene.paths[0].keys) {
    hash = hash_u32(hash, static_cast<uint32_t>(std::bit_cast<uint64_t>(key.position.y) >> 12));
  }
  return hash;
}

TEST(Canyon, IsTheSameTwiceAndAnotherWithAnotherSeed) {
  EXPECT_EQ(hash_of(make_canyon(1)), hash_of(canyon()));
  EXPECT_NE(hash_of(make_canyon(2)), hash_of(canyon()));
}

TEST(Canyon, HasTheSizeAndTheTrianglesOfItsDescription) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_canyon(seed);
    EXPECT_EQ(scene.bounds.size(), glm::vec3(190, 40, 150));
    EXPECT_GT(scene.triangle_count(), 35000u);
    EXPECT_LT(scene.triangle_count(), 60000u);
    EXPECT_EQ(scene.near, 0.1f);
    EXPECT_EQ(scene.far, 220);
    EXPECT_EQ(scene.paths[0].name, "default");
    EXPECT_EQ(scene.paths[0].duration(), 40);
    EXPECT_NEAR(scene.paths[0].vertical_fov, 1.0471976, 1e-6);
  }
}

TEST(Canyon, IsWeldedAndEveryTriangleIsSound) {
  for (uint32_t seed : {1u, 7u}) {
    Scene scene = make_canyon(seed);
    std::set<std::array<uint32_t, 8>> vertices;
    for (const Vertex& v : scene.vertices) {
      std::array<uint32_t, 8> words;
      std::memcpy(words.data(), &v, sizeof v);
      EXPECT_TRUE(vertices.insert(words).second) << "twice the same vertex";
      EXPECT_NEAR(glm::length(v.normal), 1, 1e-6);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_TRUE(std::isfinite(v.position[axis]));
        EXPECT_EQ(v.position[axis] * 1024, std::round(v.position[axis] * 1024));
      }
    }
    std::vector<bool> used(scene.vertices.size(), false);
    for (uint32_t index : scene.indices) {
      ASSERT_LT(index, scene.vertices.size());
      used[index] = true;
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    uint32_t next = 0;
    for (const Draw& draw : scene.draws) {
      EXPECT_EQ(draw.first_index, next);
      EXPECT_EQ(draw.index_count % 3, 0u);
      EXPECT_LT(draw.material, scene.materials.size());
      next += draw.index_count;
    }
    EXPECT_EQ(next, scene.indices.size());
    for (size_t i = 0; i < scene.indices.size(); i += 3) {
      const Vertex& a = scene.vertices[scene.indices[i]];
      const Vertex& b = scene.vertices[scene.indices[i + 1]];
      const Vertex& c = scene.vertices[scene.indices[i + 2]];
      glm::dvec3 normal =
          glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position));
      ASSERT_GT(glm::dot(normal, normal), 0);
      // Shading normals lie on the counter-clockwise side.
      ASSERT_GT(glm::dot(normal, glm::dvec3(a.normal + b.normal + c.normal)), 0) << i;
    }
  }
}

TEST(Canyon, HasMetalAndDifferentRoughness) {
  std::set<float> roughness;
  bool metal = false;
  for (const Draw& draw : canyon().draws) {
    roughness.insert(canyon().materials[draw.material].roughness);
    metal = metal || canyon().materials[draw.material].metallic == 1;
  }
  EXPECT_GE(roughness.size(), 4u);
  EXPECT_TRUE(metal);
}

// The wanted 95th-percentile depths of scenes.md: what makes the canyon a fair stand-in.
TEST(Canyon, ViewsAreAsLongAndAsShortAsWanted) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_canyon(seed);
    RayCaster rays(scene);
    EXPECT_GE(see(scene, rays, 0).quantile(0.95), 120) << "roof, seed " << seed;
    EXPECT_LE(see(scene, rays, 6.5).quantile(0.95), 50) << "ground run, seed " << seed;
    EXPECT_LE(see(scene, rays, 12.5).quantile(0.95), 25) << "tunnel, seed " << seed;
    EXPECT_LE(see(scene, rays, 26).quantile(0.95), 15) << "inside the keep, seed " << seed;
    EXPECT_GE(see(scene, rays, 30).quantile(0.95), 150) << "rim, seed " << seed;
  }
}

TEST(Canyon, TheCameraIsNeverInRockNorCloseToAWall) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_canyon(seed);
    RayCaster rays(scene);
    glm::dvec3 last(0);
    constexpr uint32_t kFrames = 480;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      Camera camera = scene.paths[0].sample(frame, kFrames, 64, 36, scene.near, scene.far);
      DepthProbe seen = probe(rays, camera, 32, 18);
      EXPECT_EQ(seen.back_sides, 0u) << "seed " << seed << " frame " << frame;
      EXPECT_GT(seen.nearest, 0.5) << "seed " << seed << " frame " << frame;
      EXPECT_GT(seen.quantile(0.5), 2) << "seed " << seed << " frame " << frame;
      glm::dvec3 here(camera.position);
      if (frame > 0) {
        EXPECT_TRUE(rays.clear(last, here)) << "seed " << seed << " frame " << frame;
      }
      last = here;
    }
  }
}

TEST(Canyon, AFewLightsReachEveryPixelWhateverTheCount) {
  RayCaster rays(canyon());
  for (uint32_t count : {8192u, 65536u}) {
    LightSpec spec;
    spec.count = count;
    LightSet set(spec, canyon());
    double lights = 0, pixels = 0;
    for (uint32_t frame = 0; frame < kCiFrames; frame += 3) {
      Camera camera = canyon().paths[0].sample(frame, kCiFrames, 64, 36, canyon().near, canyon().far);
      DepthProbe seen = probe(rays, camera, 10, 6);
      for (const glm::dvec3& point : seen.points) {
        ++pixels;
        for (const Light& light : set.base()) {
          glm::dvec3 step = light.position - point;
          double radius = light.radius;
          if (glm::dot(step, step) < radius * radius) ++lights;
        }
      }
    }
    EXPECT_GE(lights / pixels, 2) << count;
    EXPECT_LE(lights / pixels, 4) << count;
  }
}

TEST(Canyon, ForeignPlacementsGetASizeOfTheirOwn) {
  for (Placement placement : {Placement::area, Placement::triangle}) {
    LightSpec spec;
    spec.placement = placement;
    LightSet set(spec, canyon());
    EXPECT_EQ(set.base().size(), 8192u);
    EXPECT_GT(set.base_size(), 0.1f);
    EXPECT_LT(set.base_size(), 10);
  }
}

TEST(LoadScene, OffsetMovesOnlyTheOrigin) {
  SceneSpec spec;
  spec.procedural = "canyon";
  Scene here = load_scene(spec);
  spec.offset = {1e6, -2e5, 1e9};
  Scene there = load_scene(spec);
  EXPECT_EQ(hash_of(here), hash_of(there));
  EXPECT_EQ(there.origin - here.origin, spec.offset);
}

TEST(LoadScene, RefusesWhatItCannotLoad) {
  SceneSpec spec;
  EXPECT_THROW(load_scene(spec), UsageError);
  spec.procedural = "cannyon";
  try {
    load_scene(spec);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'canyon'"), std::string::npos) << error.what();
  }
  spec.gltf = "level.glb";
  EXPECT_THROW(load_scene(spec), UsageError);
  spec = {};
  spec.procedural = "plane";
  for (double bad : {1.1e9, -1e300, std::nan("")}) {
    spec.offset = {0, bad, 0};
    EXPECT_THROW(load_scene(spec), UsageError);
  }
}

TEST(LoadScene, EveryListedSceneLoadsUnderItsName) {
  for (const SceneInfo& info : procedural_scenes()) {
    SceneSpec spec;
    spec.procedural = info.name;
    Scene scene = load_scene(spec);
    EXPECT_EQ(scene.name, info.name);
    EXPECT_EQ(&scene.path("default"), &scene.paths[0]);
    EXPECT_FALSE(info.summary.empty());
    try {
      scene.path("defualt");
      FAIL();
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("default"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace ml
