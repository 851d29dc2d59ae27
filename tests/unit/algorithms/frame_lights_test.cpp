// The lights of a frame as algorithms see them: bounding balls and what the GPU gets of each shape.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/frame/frame_input.h"
#include "random_shapes.h"

namespace ml {
namespace {

using namespace test;

// Farthest point of the light's volume from its position, with the axes that the GPU has.
double farthest(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra) {
  const auto shape = static_cast<LightShape>(core.id_shape >> 24);
  const glm::dvec3 side(extra.side);
  if (has_segment(shape)) return double{extra.half_length} * glm::length(side) + double{core.radius};
  if (shape != LightShape::box) return core.radius;
  const glm::dvec3 half(gpu_data::box_half_extents(extra)), front(extra.direction),
      up(glm::cross(front, side));
  double max_distance = 0;
  for (double y : {-1.0, 1.0})
    for (double z : {-1.0, 1.0})
      max_distance =
          std::max(max_distance, glm::length(side * half.x + up * (y * half.y) + front * (z * half.z)));
  return max_distance;
}

TEST(FrameLights, TheBoundingBallHoldsTheVolumeAndLittleMore) {
  Random random(1);
  const std::vector<Light> lights = random_shapes(20000, random);
  FrameLightStorage storage;
  storage.fill(lights, glm::vec3(1, 2, 3));
  const FrameLights frame = storage.lights();
  ASSERT_EQ(frame.extra.size(), lights.size());
  for (size_t i = 0; i < lights.size(); ++i) {
    const double reach = farthest(frame.core[i], frame.extra[i]);
    EXPECT_GE(double{frame.radius[i]}, reach) << i;
    EXPECT_GE(frame.radius[i], frame.core[i].radius) << i << ": also when its effect is off";
    EXPECT_LE(double{frame.radius[i]}, reach * (1 + 2e-6)) << i;
    EXPECT_EQ(frame.radius[i], frame.extra[i].bound_radius) << i;
    EXPECT_EQ(frame.core[i].radius, lights[i].radius) << i;
    EXPECT_EQ(frame.core[i].id_shape, i | static_cast<uint32_t>(lights[i].shape) << 24);
  }
}

TEST(FrameLights, ProbeLightsKeepShapeAndNumberAndAreDirectOnesWithoutTheEffect) {
  Random random(9);
  std::vector<Light> lights = random_shapes(200, random);
  for (size_t i = 0; i < lights.size(); i += 3) lights[i].probe = true;
  FrameLightStorage storage;
  for (bool probes : {true, false}) {
    storage.fill(lights, glm::vec3(0), probes ? all_light_shapes : all_light_shapes & ~probe_lights_bit);
    const FrameLights frame = storage.lights();
    for (size_t i = 0; i < lights.size(); ++i) {
      const uint32_t word = frame.core[i].id_shape;
      EXPECT_EQ(word & ML_LIGHT_ID_MASK, i);
      EXPECT_EQ(word >> 24, static_cast<uint32_t>(lights[i].shape));
      EXPECT_EQ((word & ML_LIGHT_PROBE) != 0, probes && lights[i].probe);
    }
  }
}

TEST(FrameLights, TheBallsOfOmniLightsSpotsAndSegmentsWithoutLengthAreTheirOwn) {
  Random random(2);
  std::vector<Light> lights = random_shapes(4000, random);
  for (Light& light : lights) light.half_length = 0;
  FrameLightStorage storage;
  storage.fill(lights, glm::vec3(0));
  for (size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].shape == LightShape::box) continue;
    EXPECT_EQ(storage.lights().radius[i], lights[i].radius);
  }
}

TEST(FrameLights, ExtrasAreThereWhenALightNeedsThem) {
  Random random(3);
  const std::vector<Light> lights = random_shapes(5, random);
  FrameLightStorage storage;
  for (uint32_t shape = 0; shape < 5; ++shape) {
    storage.fill({lights[0], lights[shape]}, glm::vec3(0));
    EXPECT_EQ(storage.lights().extra.size(), shape == 0 ? 0u : 2u);
  }
}

TEST(FrameLights, AxesComeOutUnitAndAtRightAngles) {
  // As crooked as is accepted.
  Light light;
  light.shape = LightShape::wedge;
  light.half_length = 100;
  light.direction = {0, -1.0004f, 0};
  light.side = {0.9996f, 5e-4f, 0};
  Light box = light;
  make_box(box, {3, 4, 5});
  Light tube = light;
  tube.shape = LightShape::capsule;
  ASSERT_EQ(rejection_reason(light), nullptr);
  FrameLightStorage storage;
  storage.fill({light, box, tube}, glm::vec3(0));
  for (const gpu_data::LightExtra& extra : storage.lights().extra) {
    EXPECT_NEAR(glm::length(glm::dvec3(extra.side)), 1, 1e-7);
    EXPECT_NEAR(glm::dot(extra.side, extra.direction), 0, 1e-7);
  }
  EXPECT_NEAR(glm::length(glm::dvec3(storage.lights().extra[1].direction)), 1, 1e-7);
}

}  // namespace
}  // namespace ml
