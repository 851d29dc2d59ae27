// Capsules, wedges and boxes: ordinary, degenerate and extreme ones.
#include <cmath>

#include "harness/accuracy/image_metrics.h"
#include "harness/lights/set.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 80, height = 45;
constexpr glm::dvec3 low{-30, -1, -40}, high{30, 12, 14};

Camera yard_camera(uint32_t w = width, uint32_t h = height) {
  return camera_at({0, 3, 14}, {0, 1, -10}, w, h);
}

TEST_F(HardCases, Case24_AllShapesMixed) {
  Exactness check(yard(), width, height, all_shapes());
  Seen seen =
      check.expect_exact(yard_camera(), mixed_shapes(600, low, high, 1, 20, 24), usual_settings(), 200);
  EXPECT_GT(seen.contributing(), seen.lit_pixels());
}

TEST_F(HardCases, Case24_EachShapeAlone) {
  Exactness check(yard(), width, height, all_shapes());
  const std::vector<Light> all = mixed_shapes(1500, low, high, 0.2f, 8, 25);
  for (uint32_t shape = 0; shape < 5; ++shape) {
    SCOPED_TRACE(light_shape_names()[shape]);
    std::vector<Light> lights;
    for (const Light& light : all)
      if (static_cast<uint32_t>(light.shape) == shape) lights.push_back(light);
    EXPECT_GT(check.expect_exact(yard_camera(), lights, {{.tile = 9, .refinement = true}}, 60).contributing(),
              300u);
  }
}

TEST_F(HardCases, Case24_ManyOfAllShapes) {
  Exactness check(yard(), 16, 9, all_shapes(true));
  check.expect_exact(yard_camera(16, 9), mixed_shapes(65537, low, high, 0.1f, 3, 26),
                     {{.tile = 8, .refinement = true, .duplicated = true}}, 4);
}

// Without a length they give the bits of omni lights and spots: counts, sets and the picture.
TEST_F(HardCases, Case24_WithoutALengthTheyAreOmniLightsAndSpots) {
  Exactness check(yard(), width, height, all_shapes());
  const std::vector<Light> plain = scattered(400, low, high, 0.2f, 9, 27, 2);
  std::vector<Light> degenerate = plain;
  for (size_t i = 0; i < plain.size(); ++i) {
    const glm::vec3 axis = plain[i].direction;
    const glm::vec3 side =
        glm::cross(axis, std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
    degenerate[i].shape = plain[i].shape == LightShape::spot ? LightShape::wedge : LightShape::capsule;
    degenerate[i].side = glm::normalize(side) * (i % 2 ? 1.0f : -1.0f);
  }
  const Seen before = check.expect_exact(yard_camera(), plain),
             after = check.expect_exact(yard_camera(), degenerate);
  EXPECT_EQ(before.truth.count, after.truth.count);
  EXPECT_EQ(before.truth.hash, after.truth.hash);
  EXPECT_EQ(compare_images(before.image, after.image).differing_bits, 0u);
}

TEST_F(HardCases, Case24_MirroredSidesGiveTheSameLights) {
  Exactness check(yard(), width, height, all_shapes());
  std::vector<Light> lights = mixed_shapes(300, low, high, 0.2f, 9, 28);
  const Seen before = check.expect_exact(yard_camera(), lights, {{.tile = 16}});
  for (Light& light : lights) light.side = -light.side;
  const Seen after = check.expect_exact(yard_camera(), lights, {{.tile = 16}});
  EXPECT_EQ(before.truth.count, after.truth.count);
  EXPECT_EQ(before.truth.hash, after.truth.hash);
}

TEST_F(HardCases, Case24_WhatIsForcedOffShinesLikeAnOmniLight) {
  const std::vector<Light> lights = mixed_shapes(300, low, high, 0.2f, 9, 29);
  std::vector<Light> plain = lights;
  for (Light& light : plain) light.shape = LightShape::omni;
  Exactness off(yard(), width, height, {.many_lights = false});
  const Seen a = off.expect_exact(yard_camera(), lights), b = off.expect_exact(yard_camera(), plain);
  EXPECT_EQ(a.truth.count, b.truth.count);
  EXPECT_EQ(a.truth.hash, b.truth.hash);
  EXPECT_EQ(compare_images(a.image, b.image).differing_bits, 0u);
}

TEST_F(HardCases, Case24_NeedlesAndSheets) {
  // Lengths, radii and extents of many orders of magnitude, on surfaces and through them.
  Exactness check(yard(), width, height, all_shapes());
  std::vector<Light> lights;
  for (float radius : {1e-3f, 0.05f, 2.0f})
    for (float length : {1e-6f, 0.5f, 30.0f, 1000.0f})
      for (double y : {0.0, 0.01, 1.0}) {
        lights.push_back(capsule({0, y, 4}, radius, {1, 0, 0}, length));
        lights.push_back(capsule({2, y, 2}, radius, {0.3f, 0, -1}, length));
        lights.push_back(wedge(spot({-2, y, 3}, radius, {0, -1, 0}, 0, 40), {0, 0, 1}, length));
        lights.push_back(wedge(spot({-2, y, 3}, radius, {0, -1, 0.1f}, 100, 180), {1, 0, 0}, length));
        lights.push_back(box({1, y, 5}, {0, -1, 0}, {1, 0, 0}, {length, radius, length}));
        lights.push_back(box({1, y, 5}, {0, -1, 0}, {1, 0, 1}, {radius, length, 0.5f}));
      }
  for (float size : {kMinLightRadius, 1e5f}) {
    lights.push_back(capsule({0, 1, 5}, kMinLightRadius, {1, 0, 0}, size));
    lights.push_back(box({0, 1, 5}, {0, 0, 1}, {1, 0, 0}, {size, kMinLightRadius, size}));
    lights.push_back(box({0, 1, 5}, {0, 0, 1}, {1, 0, 0}, {size, size, size}));
  }
  check.expect_exact(yard_camera(), lights, usual_settings(), 0);
}

TEST_F(HardCases, Case24_SurfacesAtTheFacesAndAtTheRadius) {
  Exactness check(floor_at({0, 0, 0}, 4), 33, 33, all_shapes());
  const Camera above = camera_at({0, 3, 0}, {0, 0, 0}, 33, 33);
  auto contributing = [&](double y) {
    std::vector<uint64_t> counts;
    for (const Light& light : {capsule({0.3, y, 0}, 1, {1, 0, 0}, 0.7f),
                               wedge(spot({0, y, 0}, 1, {0, -1, 0}, 20, 60), {0, 0, 1}, 2),
                               box({0, y, 0}, {0, -1, 0}, {1, 0, 1}, {2, 0.5f, 1}),
                               box({0, y, 0}, {0, 0, 1}, {0, 1, 0}, {1, 2, 0.5f})})
      counts.push_back(check.expect_exact(above, {light}, {{.tile = 8}}).contributing());
    return counts;
  };
  for (uint64_t count : contributing(1.00001)) EXPECT_EQ(count, 0u);
  for (uint64_t count : contributing(0.99)) EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace ml::test
