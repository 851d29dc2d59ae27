#include <gtest/gtest.h>

#include <set>

#include "harness/lights/set.h"
#include "level_checks.h"
#include "scenes/procedural.h"
#include "tests/support/depth_probe.h"

namespace ml {
namespace {

const Scene& canyon() {
  static const Scene scene = make_canyon(1);
  return scene;
}

DepthProbe see(const Scene& scene, const RayCaster& rays, double seconds) {
  auto frame = static_cast<uint32_t>(seconds * 60);
  return probe(rays, scene.paths[0].sample(frame, 2401, 64, 36, scene.near, scene.far));
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
  for (uint32_t seed : {1u, 7u}) expect_sound(make_canyon(seed));
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
    SCOPED_TRACE(seed);
    Scene scene = make_canyon(seed);
    expect_free_camera(scene, RayCaster(scene), 480, 2);
  }
}

TEST(Canyon, AFewLightsReachEveryPixelWhateverTheCount) {
  RayCaster rays(canyon());
  for (uint32_t count : {8192u, 65536u}) {
    double lights = lights_per_point(canyon(), rays, count);
    EXPECT_GE(lights, 2) << count;
    EXPECT_LE(lights, 4) << count;
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

}  // namespace
}  // namespace ml
