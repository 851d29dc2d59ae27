// Shapes and numbers of lights.
#include <cmath>
#include <limits>

#include "harness/lights/set.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 80, height = 45;

Camera yard_camera(uint32_t w = width, uint32_t h = height) {
  return camera_at({0, 3, 14}, {0, 1, -10}, w, h);
}

// Spots of one cone at many positions and in many directions, near the camera and far from it.
std::vector<Light> cones(float inner, float outer) {
  std::vector<Light> lights;
  const glm::vec3 axes[] = {{0, -1, 0}, {0, -1, -1e-4f},   {1, 0, 0}, {-1, -1, -1},
                            {0, 0, 1},  {0.3f, -0.5f, -1}, {0, 1, 0}};
  for (glm::vec3 axis : axes)
    for (glm::dvec3 at :
         {glm::dvec3(0, 4, 8), glm::dvec3(-6, 1, -5), glm::dvec3(3, 0.5, 13), glm::dvec3(0, 3, 14)})
      for (float radius : {1.0f, 8.0f, 40.0f}) lights.push_back(spot(at, radius, axis, inner, outer));
  return lights;
}

TEST_F(HardCases, Case17_LightsThatAreNoLightsAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  for (float radius : {0.0f, -0.0f, -1.0f, nan, infinite, -infinite})
    EXPECT_NE(rejection_reason(omni({0, 0, 0}, radius)), nullptr);
  for (float intensity : {-1.0f, nan, infinite})
    EXPECT_NE(rejection_reason(omni({0, 0, 0}, 1, intensity)), nullptr);
  EXPECT_NE(rejection_reason(omni({0, static_cast<double>(nan), 0}, 1)), nullptr);
  Light crooked = spot({0, 0, 0}, 1, {0, -1, 0}, 10, 20);
  crooked.direction = {0, -2, 0};
  EXPECT_NE(rejection_reason(crooked), nullptr);
  EXPECT_EQ(rejection_reason(omni({0, 0, 0}, 1, 0)), nullptr) << "a light may be off";
  // The smallest and the largest light that are accepted, and one that is off, beside an ordinary one.
  Exactness check(yard(), width, height);
  check.expect_exact(yard_camera(), {omni({0, 1, 5}, kMinLightRadius), omni({0, 50, 0}, 1e5f, 1e4f),
                                     omni({0, 2, 4}, 5, 0), omni({2, 2, 4}, 5)});
}

TEST_F(HardCases, Case18_FalloffIsZeroAtTheRadius) {
  // Floors at the very edge of the light's reach: the light counts for no pixel from its radius on.
  Exactness check(floor_at({0, 0, 0}, 4), 33, 33);
  const Camera above = camera_at({0, 3, 0}, {0, 0, 0}, 33, 33);
  for (float radius : {1.0f, 0.3f, 7.0f}) {
    EXPECT_EQ(check.expect_exact(above, {omni({0, static_cast<double>(radius) * 1.00001, 0}, radius)})
                  .contributing(),
              0u);
    EXPECT_GT(
        check.expect_exact(above, {omni({0, static_cast<double>(radius) * 0.99, 0}, radius)}).contributing(),
        0u);
  }
}

TEST_F(HardCases, Case19_NarrowCones) {
  Exactness check(yard(), width, height);
  check.expect_exact(yard_camera(), cones(0.1f, 0.3f));
  check.expect_exact(yard_camera(), cones(0, 0.02f));
}

TEST_F(HardCases, Case20_ConesOfZeroAndNinetyDegrees) {
  Exactness check(yard(), width, height);
  check.expect_exact(yard_camera(), cones(0, 90));
  check.expect_exact(yard_camera(), cones(90, 90));
  check.expect_exact(yard_camera(), cones(20, 20));
  // The smallest cone there is: it has an axis and next to nothing around it.
  check.expect_exact(yard_camera(), cones(0, 1e-4f));
}

TEST_F(HardCases, Case21_ConesOverNinetyDegrees) {
  Exactness check(yard(), width, height);
  check.expect_exact(yard_camera(), cones(60, 120));
  check.expect_exact(yard_camera(), cones(120, 120));
  check.expect_exact(yard_camera(), cones(0, 180));
  check.expect_exact(yard_camera(), cones(180, 180));
}

TEST_F(HardCases, Case22_SpotBeforeACloseAndNarrowCamera) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights;
  for (int i = 0; i < 60; ++i)
    lights.push_back(
        spot({0.02 * i - 0.6, 0.4, 12 - 0.05 * i}, 2, {0.2f, -1, -0.3f}, 5, static_cast<float>(6 + i)));
  Camera camera = Camera::look_at({0, 0.5, 12.5}, {0, 0, 11.5},
                                  Projection::perspective(4 * degrees, 16.0f / 9, 0.05f, 200));
  check.expect_exact(camera, lights);
}

TEST_F(HardCases, Case23_SurfaceOnTheConesAxis) {
  // The ray through a pixel's centre is the cone's axis, along which every cosine is 1 but for rounding.
  Exactness check(floor_at({0, 0, 0}, 50), 33, 33);
  const Camera above = camera_at({0, 9, 0}, {0, 0, 0}, 33, 33);
  std::vector<Light> lights;
  for (float outer : {0.05f, 1.0f, 45.0f})
    for (double high : {0.5, 4.0, 8.9}) lights.push_back(spot({0, high, 0}, 12, {0, -1, 0}, 0, outer));
  Seen seen = check.expect_exact(above, lights);
  EXPECT_EQ(seen.truth.count[16 * 33 + 16], lights.size());
}

TEST_F(HardCases, Case25_CountsAroundTheWidthsOfVectors) {
  Exactness check(yard(), 48, 27);
  std::vector<Light> all = scattered(2 * 2048 + 9, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 25);
  std::vector<uint32_t> counts{0, 1, 2, 3};
  for (uint32_t lanes : {8u, 16u, 32u, 64u, 256u, 2048u})
    for (uint32_t count : {lanes - 1, lanes, lanes + 1}) counts.push_back(count);
  for (uint32_t count : {4095u, 4096u, 4097u, 4105u}) counts.push_back(count);
  for (uint32_t count : counts) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    std::vector<Light> lights(all.begin(), all.begin() + count);
    Seen seen = check.expect_exact(yard_camera(48, 27), lights,
                                   {{.tile = 16}, {.tile = 9, .refinement = true, .duplicated = true}}, 1);
    EXPECT_TRUE(count > 0 || seen.contributing() == 0);
  }
}

TEST_F(HardCases, Case25_SixtyFiveThousandLights) {
  Exactness check(yard(), 16, 9, {.effects = {.spots = true}, .many_lights = true});
  std::vector<Light> all = scattered(65537, {-30, -1, -40}, {30, 12, 14}, 0.1f, 3, 26);
  for (uint32_t count : {65535u, 65536u, 65537u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    std::vector<Light> lights(all.begin(), all.begin() + count);
    check.expect_exact(yard_camera(16, 9), lights,
                       {{.tile = 8}, {.tile = 8, .refinement = true, .duplicated = true}}, 2);
  }
}

TEST_F(HardCases, Case25_EveryOneOfManyLightsIsReached) {
  // All lights reach all pixels of a floor, so every count must be the number of lights: the references share
  // no loop with this one.
  Exactness check(floor_at({0, 0, 0}, 100), 8, 8, {.effects = {.spots = true}, .many_lights = true});
  const Camera above = camera_at({0, 3, 0}, {0, 0, 0}, 8, 8);
  for (uint32_t count : {1000u, 65535u, 65536u, 65537u, 100000u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    Seen seen =
        check.expect_exact(above, std::vector<Light>(count, omni({0, 2, 0}, 50, 1e-3f)), {{.tile = 8}}, 1);
    EXPECT_EQ(seen.truth.count, std::vector<uint32_t>(64, count));
  }
}

TEST_F(HardCases, Case25_SixtyFiveThousandLightsAtOnePoint) {
  Exactness check(yard(), 16, 9, {.effects = {.spots = true}, .many_lights = true});
  // At one point, and so in one tile.
  std::vector<Light> same(65536, omni({0, 1, 6}, 3, 1e-3f));
  Seen seen =
      check.expect_exact(yard_camera(16, 9), same, {{.tile = 16}, {.tile = 4, .refinement = true}}, 2);
  EXPECT_GT(seen.contributing(), 65536u);
  for (uint32_t count : seen.truth.count) EXPECT_TRUE(count == 0 || count == 65536) << count;
}

TEST_F(HardCases, Case26_IdenticalDepthsInAnyOrder) {
  // Many lights at equal depths: lists ascend whatever the order, so the picture is that of brute force, bit
  // for bit.
  Exactness check(yard(), width, height);
  std::vector<Light> lights;
  for (int i = 0; i < 3000; ++i)
    lights.push_back(omni({0.3 * (i % 60) - 9, 1, 4 - 2 * (i % 3)}, 1.5f, static_cast<float>(1 + i % 7)));
  Seen seen = check.expect_exact(yard_camera(), lights);
  EXPECT_GT(seen.contributing(), seen.lit_pixels());
}

TEST_F(HardCases, NarrowConesRimsLightPixelsAlone) {
  // A rim is faint, but nothing else shines there: a cone factor that is a difference of cosines has few
  // right digits.
  constexpr uint32_t wide = 120, high = 68;
  Exactness check(floor_at({0, 0, 0}, 20), wide, high);
  std::vector<Light> lights;
  for (float outer : {1.0f, 2.0f, 4.0f, 8.0f, 12.0f}) {
    const auto angle = static_cast<double>(outer);
    lights.push_back(spot({0.6 * angle - 4, 5, 0.1 * angle}, 30, {0.1f, -1, 0.05f}, 0.1f * outer, outer));
  }
  const Seen seen =
      check.expect_exact(camera_at({0, 6, 5}, {0, 0, 0}, wide, high), lights, {{.tile = 16}}, wide * high);
  EXPECT_GT(seen.contributing(), 300u);
}

}  // namespace
}  // namespace ml::test
