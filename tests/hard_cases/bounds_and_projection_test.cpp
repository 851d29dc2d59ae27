// Bounds and projections.
#include <cmath>
#include <limits>

#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 96, height = 54;

Camera yard_camera(uint32_t w = width, uint32_t h = height, float near = 0.1f) {
  return camera_at({0, 3, 14}, {0, 1, -10}, w, h, near);
}

// Unit vectors that are not along any axis of the picture.
const glm::dvec3 ahead = glm::normalize(glm::dvec3(0, -2, -24)), aside(1, 0, 0);

TEST_F(HardCases, Case01_LightStraddlesTheNearPlane) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights;
  const glm::dvec3 eye(0, 3, 14);
  for (double depth : {-0.5, -0.1, 0.0, 0.05, 0.1, 0.1000001, 0.15, 0.5})
    for (double off : {-3.0, -0.2, 0.0, 0.1, 2.0})
      for (float radius : {0.06f, 0.5f, 4.0f, 15.0f})
        lights.push_back(omni(eye + ahead * depth + aside * off, radius));
  for (float near : {0.1f, 1.0f, 5.0f}) check.expect_exact(yard_camera(width, height, near), lights);
}

TEST_F(HardCases, Case02_CameraInsideTheLight) {
  Exactness check(yard(), width, height);
  const glm::dvec3 eye(0, 3, 14);
  std::vector<Light> lights{omni(eye, 1e-3f),
                            omni(eye, 3),
                            omni(eye, 40),
                            omni(eye + glm::dvec3(0, 0, 39.999), 40),
                            omni(eye - glm::dvec3(0, 2.9, 0), 4),
                            omni(eye, 1e6f, 1e6f),
                            spot(eye, 30, {0, -0.2f, -1}, 5, 20),
                            spot(eye + glm::dvec3(0, 1, 3), 30, {0, 0, 1}, 60, 120)};
  Seen seen = check.expect_exact(yard_camera(), lights);
  // The light of a million metres reaches every surface that faces it.
  EXPECT_GE(seen.contributing(), seen.lit_pixels() / 2);
}

TEST_F(HardCases, Case03_LightCentreBehindTheCamera) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights;
  for (double back : {0.01, 0.5, 3.0, 20.0, 300.0})
    for (double off : {-50.0, -1.0, 0.0, 4.0})
      for (double reach : {0.05, 1.0, 12.0})
        lights.push_back(
            omni(glm::dvec3(0, 3, 14) - ahead * back + aside * off, static_cast<float>(back + reach)));
  check.expect_exact(yard_camera(), lights);
}

TEST_F(HardCases, Case04_LightInsideOneFroxel) {
  // A light of 2 cm just above the floor and far smaller than any froxel, at many positions.
  Exactness check(yard(), width, height);
  std::vector<Light> lights;
  for (int i = 0; i < 400; ++i) lights.push_back(omni({-10 + 0.05 * i, 0.01, 9 - 0.03 * i}, 0.05f));
  std::vector<GridSettings> settings = usual_settings();
  settings.push_back({.tile = 1024, .slices = 1});
  settings.push_back({.tile = 1024, .slices = 1, .refinement = true});
  check.expect_exact(yard_camera(), lights, settings);
}

TEST_F(HardCases, Case05_LightsAtTheBordersOfThePicture) {
  // Centres outside, reach inside; every border, tiles that end there and tiles that do not.
  Exactness check(yard(), 97, 61);
  const Camera camera = yard_camera(97, 61);
  std::vector<Light> lights;
  for (float depth : {1.0f, 6.0f, 25.0f, 90.0f})
    for (int step = -12; step <= 12; ++step)
      for (float side : {-1.02f, -1.0f, 1.0f, 1.02f}) {
        const Projection& p = camera.projection;
        const float along = static_cast<float>(step) / 10;
        for (glm::vec2 at :
             {glm::vec2(side * p.right, along * p.top), glm::vec2(along * p.right, side * p.top)}) {
          glm::vec3 position =
              camera.position + (camera.forward + camera.right * at.x + camera.up * at.y) * depth;
          for (float radius : {0.02f, 0.1f}) lights.push_back(omni(position, radius * depth));
        }
      }
  std::vector<GridSettings> settings = usual_settings();
  settings.push_back({.tile = 97});
  settings.push_back({.tile = 96, .refinement = true});
  check.expect_exact(camera, lights, settings);
}

TEST_F(HardCases, Case06_SpheresInTheCornersOfAWideView) {
  Exactness check(yard(), 120, 40);
  Camera camera =
      Camera::look_at({0, 3, 14}, {0, 1, -10}, Projection::perspective(140 * degrees, 3, 0.1f, 200));
  std::vector<Light> lights = scattered(300, {-60, -2, -30}, {60, 25, 13}, 0.2f, 20, 6);
  check.expect_exact(camera, lights);
}

TEST_F(HardCases, Case07_OrthographicCameras) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(250, {-30, -1, -40}, {30, 12, 30}, 0.2f, 12, 7);
  for (float half : {2.0f, 15.0f, 80.0f})
    for (float near : {0.05f, 1.0f, 20.0f}) {
      Projection projection = Projection::orthographic(half, half * 9 / 16, near, 150);
      check.expect_exact(Camera::look_at({5, 12, 30}, {0, 0, -5}, projection), lights, usual_settings(),
                         half > 10 ? 6 : 0);
    }
  // Straight down, off the centre, every row at one depth.
  Projection window = Projection::orthographic(20, 11, 0.1f, 60);
  window.left = -5, window.top = 25;
  check.expect_exact(Camera::look_at({0, 30, 0}, {0, 0, 0}, window), lights);
}

TEST_F(HardCases, Case08_OffCentreAndJitteredProjections) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(250, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 8);
  for (glm::vec2 shift :
       {glm::vec2(0.001f, -0.0007f), glm::vec2(0.9f, 0.1f), glm::vec2(-1.5f, -0.5f), glm::vec2(3, 0)}) {
    Camera camera = yard_camera();
    camera.projection.left += shift.x, camera.projection.right += shift.x;
    camera.projection.bottom += shift.y, camera.projection.top += shift.y;
    check.expect_exact(camera, lights);
  }
  Camera narrow = yard_camera();
  narrow.projection.left = 0.20f, narrow.projection.right = 0.21f, narrow.projection.bottom = -0.051f,
  narrow.projection.top = -0.05f;
  check.expect_exact(narrow, lights);
}

TEST_F(HardCases, Case10_TinyNearAndHugeFar) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(200, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 10);
  for (glm::vec2 range :
       {glm::vec2(1e-6f, 1e9f), glm::vec2(1e-4f, 1e3f), glm::vec2(3, 3.001f), glm::vec2(12, 1e30f)}) {
    std::vector<GridSettings> settings = usual_settings();
    settings.push_back({.slices = 256, .zmin = 0.01});
    settings.push_back({.zmin = 100, .zmax = 100.001});
    check.expect_exact(camera_at({0, 3, 14}, {0, 1, -10}, width, height, range.x, range.y), lights, settings,
                       6);
  }
}

TEST_F(HardCases, Case11_LightsAndSurfacesBeyondTheGrid) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(300, {-60, -1, -180}, {60, 8, 10}, 0.5f, 15, 11);
  for (double zmax : {6.0, 12.0, 30.0}) {
    std::vector<GridSettings> settings;
    for (int64_t slices : {1, 2, 16, 64})
      for (bool refinement : {false, true})
        settings.push_back({.tile = 16, .slices = slices, .zmin = 5, .zmax = zmax, .refinement = refinement});
    check.expect_exact(yard_camera(), lights, settings, 4);
  }
}

TEST_F(HardCases, Case12_NothingIsUnlitBetweenNearAndTheFirstSlice) {
  // The camera hovers 30 cm above the floor; slices begin at 10 cm, 1 m and 1 km.
  Exactness check(yard(), width, height);
  const Camera camera = camera_at({0, 0.3, 14}, {0, 0.05, 13.6}, width, height, 0.01f);
  std::vector<Light> lights = scattered(60, {-1, 0, 12}, {1, 0.4, 14.5}, 0.1f, 2, 12);
  std::vector<GridSettings> settings;
  for (double zmin : {0.01, 0.1, 1.0, 1000.0})
    for (bool refinement : {false, true})
      settings.push_back({.tile = 8, .zmin = zmin, .refinement = refinement});
  Seen seen = check.expect_exact(camera, lights, settings);
  EXPECT_GT(seen.contributing(), seen.lit_pixels());
}

TEST_F(HardCases, Case14_PicturesThatAreNoMultipleOfTheTile) {
  const Scene scene = yard();
  std::vector<Light> lights = scattered(150, {-30, -1, -40}, {30, 12, 14}, 0.5f, 15, 14);
  for (glm::uvec2 size :
       {glm::uvec2(1, 1), glm::uvec2(1, 97), glm::uvec2(97, 1), glm::uvec2(9, 33), glm::uvec2(65, 17)}) {
    SCOPED_TRACE(testing::Message() << size.x << "x" << size.y);
    Exactness check(scene, size.x, size.y);
    // A picture of one row or column still looks at the floor.
    Camera camera =
        Camera::look_at({0, 3, 14}, {0, 0, 6}, Projection::perspective(40 * degrees, 1, 0.1f, 200));
    check.expect_exact(camera, lights,
                       {{.tile = 24}, {.tile = 4, .refinement = true}, {.tile = 1024, .duplicated = true}},
                       3);
  }
}

// Straight down and up, near it, and with roll: no pitch and no roll is special to bounds and grids.
TEST_F(HardCases, Case58_SteepPitchWithRoll) {
  HandMadeScene made;
  made.rectangle({-30, 0, 30}, {60, 0, 0}, {0, 0, -60});  // a floor
  made.rectangle({-30, 9, -30}, {60, 0, 0}, {0, 0, 60});  // a ceiling
  for (int i = 0; i < 6; ++i) {
    const float x = 2.5f * static_cast<float>(i) - 7, z = 3.0f * static_cast<float>(i % 3) - 4;
    made.box({x, 0, z}, {x + 1, 1 + 0.5f * static_cast<float>(i), z + 1});
    made.box({z, 8 - 0.3f * static_cast<float>(i), x}, {z + 0.5f, 9, x + 2});
  }
  Exactness check(made.finish(), width, height);
  const std::vector<Light> lights = scattered(150, {-12, -1, -12}, {12, 10, 12}, 0.2f, 6, 58);
  const Projection wide = Projection::perspective(75 * degrees, 16.0f / 9, 0.05f, 60);
  const Projection flat = Projection::orthographic(9, 5, 0.05f, 20);
  for (double pitch : {-90.0, 90.0, -89.5, 89.97}) {
    for (double roll : {0.0, 35.0, 180.0, 271.0}) {
      const double p = pitch * 0.017453292519943295, r = roll * 0.017453292519943295;
      // Seen along `forward` with `level` up, then rolled about it.
      const glm::dvec3 forward(0.6 * std::cos(p), std::sin(p), -0.8 * std::cos(p)),
          level(-0.6 * std::sin(p), std::cos(p), 0.8 * std::sin(p)),
          side = glm::cross(forward, level), up = std::cos(r) * level + std::sin(r) * side,
          eye(0.3, 4.2, -0.4);
      SCOPED_TRACE(testing::Message() << "pitch " << pitch << ", roll " << roll);
      const Camera camera = Camera::look_at(eye, eye + forward, roll == 180 ? flat : wide, up);
      EXPECT_LT(glm::length(glm::dvec3(camera.up) - up), 1e-6);
      const Seen seen =
          check.expect_exact(camera, lights, {{.tile = 24}, {.tile = 8, .refinement = true}}, 3);
      EXPECT_GT(seen.contributing(), 0u);
    }
  }
}

}  // namespace
}  // namespace ml::test
