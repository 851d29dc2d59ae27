// The reference proves itself: brute force looks at every light of the frame from every lit pixel, and the
// lists of contributing lights are its own, at any number of lights.
#include <gtest/gtest.h>

#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 8, height = 8;
const FrameOptions many{.many_lights = true};

// Lights that few pixels have in common, in an order that keeps the lanes of a subgroup apart: while one
// looks for its next light the others wait.
std::vector<Light> apart(uint32_t count) {
  Random random(hash_u32(count, 49));
  std::vector<Light> lights;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t patch = (i / 64 + random.below(2)) % 64;
    const float x = (static_cast<float>(patch % 8) + 0.5f) * 4 - 16,
                z = (static_cast<float>(patch / 8) + 0.5f) * 4 - 16;
    lights.push_back(omni({static_cast<double>(x), 0.5, static_cast<double>(z)}, 2.2f));
  }
  return lights;
}

void expect_reference(Exactness& check, uint32_t count) {
  SCOPED_TRACE(count);
  const Camera camera = camera_at({0, 28, 0.1}, {0, 0, 0}, width, height);
  const Seen seen = check.expect_trials(camera, apart(count), {}, 0);
  for (size_t i = 0; i < seen.lit.size(); ++i) {
    if (!seen.lit[i]) continue;
    ASSERT_EQ(seen.reference.tested[i], count) << "pixel " << i;
    ASSERT_EQ(seen.reference.listed[i], count) << "pixel " << i;
  }
}

TEST_F(HardCases, Case49_TheReferenceLooksAtEveryLight) {
  Exactness check(floor_at({0, 0, 0}, 100), width, height, many);
  for (uint32_t count :
       {0u, 1u, 255u, 7000u, 7281u, 8191u, 17000u, 20011u, 27900u, 28001u, 40000u, 65535u, 65536u, 65537u})
    expect_reference(check, count);
}

TEST_F(HardCases, Case49_AnyNumberOfLights) {
  Exactness check(floor_at({0, 0, 0}, 100), width, height, many);
  Random random(49);
  for (uint32_t i = 0; i < 6; ++i) expect_reference(check, random.below(70001));
}

// More than one dispatch looks at.
TEST_F(HardCases, Case49_MoreLightsThanOneDispatchLooksAt) {
  Exactness check(floor_at({0, 0, 0}, 100), width, height, many);
  expect_reference(check, max_lights_of_dispatch);
  expect_reference(check, max_lights_of_dispatch + 1);
  // Drivers that end loops take shorter ranges; on others these are the counts above.
  const gpu::DeviceLimits& limits = device().limits();
  const uint32_t range = lights_of_range(limits.subgroup_size, limits.loop_iterations);
  if (range < max_lights_of_dispatch)
    for (uint32_t count : {range - 1, range, range + 1, 2 * range, 2 * range + 1})
      expect_reference(check, count);
  expect_reference(check, 600001);
}

}  // namespace
}  // namespace ml::test
