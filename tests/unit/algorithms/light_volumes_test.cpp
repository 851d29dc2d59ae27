// The ball and the box around each light of light_bvh hold what it reaches, and little else.
#include "algorithms/light_bvh/light_volumes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/frame/frame_input.h"
#include "random_shapes.h"

namespace ml {
namespace {

using namespace test;

// The light where the GPU has it: its position rounded to float.
Light as_stored(const Light& light, const FrameLights& lights, uint32_t i) {
  Light stored = light;
  stored.position = glm::dvec3(lights.x[i], lights.y[i], lights.z[i]);
  return stored;
}

TEST(LightVolumes, HoldWhatTheLightReaches) {
  Random random(11);
  const std::vector<Light> lights = random_shapes(500, random);
  FrameLightStorage storage;
  storage.fill(lights, glm::vec3(0));
  const FrameLights frame = storage.lights();
  std::vector<LightVolume> volumes;
  find_volumes(frame, volumes);
  ASSERT_EQ(volumes.size(), lights.size());
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const LightVolume& volume = volumes[i];
    const Light light = as_stored(lights[i], frame, i);
    double farthest = 0;
    glm::dvec3 low(1e30), high(-1e30);
    for (int sample = 0; sample < 1000; ++sample) {
      const glm::dvec3 point = random_point_in(random, light);
      farthest = std::max(farthest, glm::distance(point, glm::dvec3(volume.center)));
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
    EXPECT_LE(farthest, volume.radius) << i;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(low[axis], volume.box.low[axis]) << i;
      EXPECT_LE(high[axis], volume.box.high[axis]) << i;
    }
    // The points come near to the box on all sides, so it is not much larger than it must be.
    const glm::dvec3 size(volume.box.high - volume.box.low);
    EXPECT_LT(glm::length(size - (high - low)), 0.15 * glm::length(size) + 1e-4)
        << i << " " << light_shape_names()[static_cast<size_t>(light.shape)] << " " << light.outer_angle;
    EXPECT_GE(farthest, 0.93 * double{volume.radius} - 1e-4)
        << i << " " << light.outer_angle << " " << light.half_length << " " << light.radius;
    EXPECT_LE(volume.radius, frame.radius[i] * 1.0001f + 1e-4f) << i;
  }
}

TEST(LightVolumes, TheBallOfANarrowConeIsFarSmallerThanTheOneAroundItsApex) {
  Light spot;
  spot.shape = LightShape::spot;
  spot.radius = 10;
  FrameLightStorage storage;
  // Half-angle, radius of the ball: through the apex and the rim up to 45 degrees, around the rim up to 90.
  for (auto [degrees, radius] :
       {std::pair(1, 5.001), {20, 5.321}, {45, 7.071}, {60, 8.660}, {90, 10.0}, {120, 10.0}}) {
    spot.outer_angle = static_cast<float>(degrees) * 3.14159265f / 180;
    storage.fill({spot}, glm::vec3(0));
    EXPECT_NEAR(volume_of(storage.lights(), 0).radius, radius, 2e-3) << degrees;
  }
}

}  // namespace
}  // namespace ml
