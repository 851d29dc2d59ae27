// Depth ranges of tiles, the sky, and cell boundaries.
#include <algorithm>
#include <array>
#include <cmath>

#include "harness/bench/case_pictures.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 80, height = 45;

TEST_F(HardCases, Case09_DepthIsAsGoodFarAwayAsNear) {
  // Walls from 1 m to 4 km, side by side. Depth is stored reversed: 1 - near/depth, the standard way, would
  // know the last wall's to some kilometres when near is 1 mm.
  constexpr uint32_t w = 100, h = 56;
  const double distances[] = {1, 10, 100, 1000, 4000};
  HandMadeScene made;
  std::vector<Light> lights;
  for (int i = 0; i < 5; ++i) {
    const double far = distances[i], left = (0.4 * i - 0.98) * far;
    const auto size = static_cast<float>(far);
    made.rectangle({static_cast<float>(left), -0.5f * size, -size}, {0.36f * size, 0, 0}, {0, size, 0});
    for (double up : {-0.3, 0.0, 0.3})
      lights.push_back(omni({left + 0.2 * far, up * far, -0.9 * far}, 0.3f * size, size * size));
  }
  Exactness check(made.finish(), w, h);
  for (float near : {0.001f, 0.1f, 0.9f}) {
    SCOPED_TRACE(near);
    const Seen seen = check.expect_exact(camera_at({0, 0, 0}, {0, 0, -1}, w, h, near, 5000), lights);
    const std::vector<float> position = check.frame().read_aov(DeviceFrame::Aov::position);
    std::array<uint32_t, 5> pixels{};
    for (size_t pixel = 0; pixel < size_t{w} * h; ++pixel) {
      if (!seen.lit[pixel]) continue;
      const double depth = static_cast<double>(position[4 * pixel + 3]);
      const auto wall = std::ranges::min_element(
          distances, {}, [&](double distance) { return std::abs(std::log(depth / distance)); });
      EXPECT_NEAR(depth, *wall, 5e-7 * *wall) << "pixel " << pixel;
      EXPECT_NEAR(static_cast<double>(position[4 * pixel + 2]), -*wall, 5e-7 * *wall) << "pixel " << pixel;
      ++pixels[static_cast<size_t>(wall - distances)];
    }
    for (uint32_t number : pixels) EXPECT_GT(number, 300u);
  }
}

TEST_F(HardCases, Case27_TilesOfOneDepth) {
  // A wall that faces the camera: every pixel of every tile has the same depth.
  Exactness check(HandMadeScene().rectangle({-20, -20, -10}, {40, 0, 0}, {0, 40, 0}).finish(), width, height);
  std::vector<Light> lights = scattered(200, {-8, -5, -14}, {8, 5, 1}, 0.2f, 6, 27);
  const Camera camera = camera_at({0, 0, 0}, {0, 0, -1}, width, height);
  check.expect_exact(camera, lights);
  Camera flat = camera;
  flat.projection = Projection::orthographic(8, 4.5f, 0.1f, 200);
  check.expect_exact(flat, lights);
}

TEST_F(HardCases, Case28_SkyAloneAndSkyMixedWithGeometry) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(200, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 28);
  Seen sky =
      check.expect_exact(camera_at({0, 3, 14}, {0, 40, -10}, width, height), lights, usual_settings(), 0);
  EXPECT_EQ(sky.lit_pixels(), 0u);
  EXPECT_EQ(sky.contributing(), 0u);
  for (float value : sky.image.data) ASSERT_EQ(value, 0.0f);
  Seen mixed = check.expect_exact(camera_at({0, 3, 14}, {0, 4, -10}, width, height), lights);
  EXPECT_GT(mixed.lit_pixels(), 0u);
  EXPECT_LT(mixed.lit_pixels(), mixed.lit.size());
  // A light around everything does not light the sky.
  for (size_t i = 0; i < mixed.lit.size(); ++i) ASSERT_TRUE(mixed.lit[i] || mixed.truth.count[i] == 0);
}

TEST_F(HardCases, Case29_SilhouettesFromCentimetresToHundredsOfMetres) {
  HandMadeScene made;
  made.rectangle({-500, 0, 1}, {1000, 0, 0}, {0, 0, -1000});
  for (int i = -6; i <= 6; ++i) {
    const auto x = static_cast<float>(i);
    made.box({x * 0.02f, 1.4f, -0.26f}, {x * 0.02f + 0.008f, 1.6f, -0.2f});  // pickets 20 cm before the eye
  }
  made.rectangle({-600, 0, -800}, {1200, 0, 0}, {0, 300, 0});
  Exactness check(made.finish(), width, height);
  std::vector<Light> lights = scattered(100, {-0.5, 1, -0.6}, {0.5, 2, 0}, 0.05f, 1, 29);
  for (const Light& light : scattered(300, {-300, 0, -800}, {300, 60, -5}, 1, 80, 30))
    lights.push_back(light);
  check.expect_exact(camera_at({0, 1.5, 0}, {0, 1.45, -1}, width, height, 0.05f, 1000), lights);
}

TEST_F(HardCases, Case30_SmallLightThreeKilometresAway) {
  HandMadeScene made;
  made.rectangle({-4000, 0, 0}, {8000, 0, 0}, {0, 0, -8000})
      .rectangle({-10, 0, -3001}, {20, 0, 0}, {0, 20, 0});
  Exactness check(made.finish(), width, height);
  std::vector<Light> lights;
  for (int i = 0; i < 9; ++i) lights.push_back(omni({-2.0 + 0.5 * i, 3, -3000.2}, 1));
  Camera far = Camera::look_at({0, 3, 0}, {0, 3, -3000},
                               Projection::perspective(0.1f * degrees, 16.0f / 9, 0.1f, 5000));
  std::vector<GridSettings> settings = usual_settings();
  settings.push_back({.slices = 256, .zmax = 5000, .refinement = true});
  Seen seen = check.expect_exact(far, lights, settings);
  EXPECT_GT(seen.contributing(), 0u) << "the lights are before the wall";
  check.expect_exact(camera_at({0, 3, 0}, {0, 3, -3000}, width, height, 0.1f, 5000), lights, settings);
}

TEST_F(HardCases, Case31_LightsThatTouchABoundary) {
  // A wall at 6 m whose lights' balls end exactly on tile edges, slice depths, and on the wall itself.
  Exactness check(HandMadeScene().rectangle({-40, -40, -6}, {80, 0, 0}, {0, 80, 0}).finish(), 64, 64);
  Camera camera = camera_at({0, 0, 0}, {0, 0, -1}, 64, 64);
  camera.projection.left = camera.projection.bottom = -1;
  camera.projection.right = camera.projection.top = 1;
  std::vector<Light> lights;
  for (int column = 0; column <= 8; ++column)
    for (float radius : {0.25f, 0.5f, 1.0f}) {
      const double edge = 6.0 * (column * 0.25 - 1);  // where a tile of 8 px ends, on the wall
      lights.push_back(omni({edge + static_cast<double>(radius), 0.1, -6}, radius));
      lights.push_back(omni({0.1, edge - static_cast<double>(radius), -6}, radius));
      lights.push_back(omni({edge, edge, -5.5}, radius));
      lights.push_back(omni({edge, 0, -6 + static_cast<double>(radius)}, radius));
    }
  std::vector<GridSettings> settings;
  // The wall lies exactly at the end of the near slice, of another slice, and of the grid.
  for (glm::dvec2 range :
       {glm::dvec2(6, 500), glm::dvec2(1.5, 96), glm::dvec2(1, 6), glm::dvec2(5.9999995, 6.0000005)})
    for (bool refinement : {false, true})
      settings.push_back(
          {.tile = 8, .slices = 4, .zmin = range.x, .zmax = range.y, .refinement = refinement});
  check.expect_exact(camera, lights, settings);
}

}  // namespace
}  // namespace ml::test
