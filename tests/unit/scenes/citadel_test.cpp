#include <gtest/gtest.h>

#include <set>

#include "level_checks.h"
#include "scenes/citadel/parts.h"
#include "scenes/procedural.h"

namespace ml {
namespace {

const Scene& citadel() {
  static const Scene scene = make_citadel(1);
  return scene;
}

TEST(Citadel, IsTheSameTwiceAndAnotherWithAnotherSeed) {
  EXPECT_EQ(hash_of(make_citadel(1)), hash_of(citadel()));
  EXPECT_NE(hash_of(make_citadel(2)), hash_of(citadel()));
}

TEST(Citadel, HasTheSizeAndTheTrianglesOfItsDescription) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_citadel(seed);
    EXPECT_EQ(scene.bounds.size(), glm::vec3(760, 100, 760)) << seed;
    EXPECT_NEAR(scene.triangle_count(), 85000, 0.15 * 85000) << seed;
    EXPECT_EQ(scene.near, 0.1f);
    EXPECT_EQ(scene.far, 900);
    EXPECT_EQ(scene.paths[0].name, "default");
    EXPECT_EQ(scene.paths[0].duration(), 60);
  }
}

TEST(Citadel, HasTheHillAndTheHousesOfItsDescription) {
  HeightField ground = make_citadel_ground(1);
  EXPECT_NEAR(ground.height(0, 0), 38, 1e-9);
  MeshBuilder mesh;
  CitadelMaterials materials{};
  mesh.add_material({});
  Random random(1);
  EXPECT_NEAR(build_town(mesh, materials, ground, random), 380, 0.05 * 380);
}

TEST(Citadel, IsWeldedAndEveryTriangleIsSound) {
  for (uint32_t seed : {1u, 7u}) expect_sound(make_citadel(seed));
}

TEST(Citadel, HasMetalAndDifferentRoughness) {
  std::set<float> roughness;
  bool metal = false;
  for (const Draw& draw : citadel().draws) {
    roughness.insert(citadel().materials[draw.material].roughness);
    metal = metal || citadel().materials[draw.material].metallic == 1;
  }
  EXPECT_GE(roughness.size(), 6u);
  EXPECT_TRUE(metal);
}

// The wanted 95th-percentile depths of scenes.md: what makes the citadel a fair stand-in.
TEST(Citadel, ViewsAreAsLongAndAsShortAsWanted) {
  constexpr uint32_t kCiFrames = 120;
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_citadel(seed);
    RayCaster rays(scene);
    int far_frames = 0, near_frames = 0;
    for (uint32_t frame = 0; frame < kCiFrames; ++frame) {
      double depth =
          probe(rays, scene.paths[0].sample(frame, kCiFrames, 64, 36, scene.near, scene.far)).quantile(0.95);
      far_frames += depth >= 250 ? 1 : 0;
      near_frames += depth <= 40 ? 1 : 0;
    }
    EXPECT_GE(far_frames, 0.3 * kCiFrames) << seed;
    EXPECT_GE(near_frames, 0.2 * kCiFrames) << seed;
  }
}

TEST(Citadel, TheCameraIsNeverInAWallNorCloseToOne) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    Scene scene = make_citadel(seed);
    expect_free_camera(scene, RayCaster(scene), 480, 2);
  }
}

TEST(Citadel, AFewLightsReachEveryPixelWhateverTheCount) {
  RayCaster rays(citadel());
  for (uint32_t count : {8192u, 65536u}) {
    double lights = lights_per_point(citadel(), rays, count);
    EXPECT_GE(lights, 2) << count;
    EXPECT_LE(lights, 4) << count;
  }
}

// Sizes of its own for both surface placements.
TEST(Citadel, AreaPlacementGivesAFewLightsTooAndSizesAreThoseOfItsDescription) {
  LightSpec spec;
  spec.count = 65536;
  EXPECT_NEAR(LightSet(spec, citadel()).base_size(), 0.8, 1e-6);
  spec.placement = Placement::area;
  EXPECT_NEAR(LightSet(spec, citadel()).base_size(), 0.9, 1e-6);
}

}  // namespace
}  // namespace ml
