// Shading: singular positions, extreme values, far from the origin.
#include <cmath>
#include <limits>

#include "harness/accuracy/image_metrics.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 65, height = 37;

TEST_F(HardCases, Case32_LightExactlyOnTheSurfacePoint) {
  Exactness check(floor_at({0, 0, 0}, 20), width, height);
  const Camera camera = camera_at({0, 3, 2}, {0, 0, 0}, width, height);
  check.expect_exact(camera, {});
  // Lights where the device itself sees the surface points: some coincide with them to the last bit.
  std::vector<float> position = check.frame().read_aov(DeviceFrame::Aov::position);
  std::vector<Light> lights;
  for (size_t pixel = 0; pixel < position.size() / 4; pixel += 61) {
    glm::dvec3 at = glm::dvec3(camera.position) +
                    glm::dvec3(position[4 * pixel], position[4 * pixel + 1], position[4 * pixel + 2]);
    for (double above : {0.0, 1e-7, 1e-5, 0.01}) lights.push_back(omni(at + glm::dvec3(0, above, 0), 0.5f));
  }
  Seen seen = check.expect_exact(camera, lights);
  EXPECT_GT(seen.contributing(), 0u);
}

TEST_F(HardCases, Case33_NormalsThatAreNoNumbersPoisonNothing) {
  // The filter is at the producer: the g-buffer's words have no code for what is no number, so that nothing
  // behind it, a history least of all, can pick one up. The rest of the picture stays as it is, bit for bit.
  const auto level = [](float broken) {
    Scene scene = HandMadeScene()
                      .rectangle({-20, 0, 20}, {40, 0, 0}, {0, 0, -40})
                      .rectangle({-2, 0, -3}, {4, 0, 0}, {0, 3, 0})
                      .finish();
    // The upright one's.
    for (size_t i = 4; i < 8; ++i) scene.vertices[i].normal = glm::vec3(0, broken, 1);
    return scene;
  };
  const Camera camera = camera_at({0, 3, 6}, {0, 1, -3}, width, height);
  const std::vector<Light> lights = scattered(80, {-6, 0.5, -6}, {6, 4, 4}, 1, 8, 33);
  Exactness sound(level(0), width, height);
  const Seen expected = sound.expect_exact(camera, lights);
  for (float broken : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    SCOPED_TRACE(broken);
    Exactness check(level(broken), width, height);
    const Seen seen = check.expect_exact(camera, lights, usual_settings(), 0);
    const std::vector<float> position = check.frame().read_aov(DeviceFrame::Aov::position),
                             normal = check.frame().read_aov(DeviceFrame::Aov::normal);
    uint32_t upright = 0;
    for (size_t pixel = 0; pixel < size_t{width} * height; ++pixel) {
      if (!seen.lit[pixel]) continue;
      const glm::vec3 n(normal[4 * pixel], normal[4 * pixel + 1], normal[4 * pixel + 2]);
      ASSERT_NEAR(glm::length(n), 1, 1e-5f) << "pixel " << pixel;
      if (position[4 * pixel + 1] + camera.position.y > 1e-3f) {
        ++upright;
        continue;
      }
      for (size_t channel = 0; channel < 3; ++channel)
        ASSERT_EQ(seen.image.data[3 * pixel + channel], expected.image.data[3 * pixel + channel])
            << "pixel " << pixel;
    }
    EXPECT_GT(upright, 100u);
  }
}

TEST_F(HardCases, Case34_RoughnessZeroAndGrazingViews) {
  HandMadeScene made;
  Material mirror;
  mirror.name = "mirror";
  mirror.roughness = 0;
  mirror.metallic = 1;
  mirror.base_color = glm::vec4(1);
  const uint32_t smooth = made.material(mirror);
  made.rectangle({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, smooth);
  made.rectangle({-1, 0, -4}, {2, 0, 0}, {0, 3, 0}, smooth);
  Exactness check(made.finish(), width, height);
  std::vector<Light> lights = scattered(60, {-6, 0, -9}, {6, 4, 6}, 1, 12, 34);
  // Mirrored at the floor exactly towards the eye: N.H is 1.
  for (int i = 0; i < 20; ++i) lights.push_back(omni({0, 0.001 + 0.05 * i, -0.3 * i}, 10));
  lights.push_back(omni({0, 2, 5}, 50));  // at the eye: L and V are the same
  for (double height_of_eye : {2.0, 0.01})
    check.expect_exact(camera_at({0, height_of_eye, 5}, {0, 0, 0}, width, height), lights);
  // From above, V = N.
  lights.push_back(omni({0, 9, 0}, 50));
  check.expect_exact(camera_at({0, 9, 0}, {0, 0, 0}, width, height), lights);
}

TEST_F(HardCases, Case36_FarFromTheOriginIsTheSamePicture) {
  // Steps of a float at 10^7 m are 1 m: a level of whole metres is the same level there, moved in double.
  constexpr uint32_t w = 64, h = 36;
  std::vector<Light> lights = scattered(100, {-8, 0, -8}, {8, 4, 8}, 0.5f, 8, 36);
  std::vector<Picture> pictures;
  for (double offset : {0.0, 1e5, 1e6, 1e7}) {
    SCOPED_TRACE(offset);
    const auto move = glm::vec3(static_cast<float>(offset));
    HandMadeScene made;
    made.rectangle(move + glm::vec3(-16, 0, 16), {32, 0, 0}, {0, 0, -32});
    made.rectangle(move + glm::vec3(-4, 0, -8), {8, 0, 0}, {0, 8, 0});
    Exactness check(made.finish(), w, h);
    std::vector<Light> moved = lights;
    // Lights are made camera-relative in double: their positions keep the bits that the subtraction leaves.
    for (size_t i = 0; i < moved.size(); ++i) {
      moved[i].position = glm::round(moved[i].position * 16.0) / 16.0;
      moved[i].position += glm::dvec3(offset);
    }
    Camera camera = Camera::look_at(glm::dvec3(0, 5, 12), {0, 1, 0},
                                    Projection::perspective(60 * degrees, 16.0f / 9, 0.1f, 200));
    camera.position += move;
    pictures.push_back(
        check.expect_exact(camera, moved, {{.tile = 16}, {.tile = 7, .refinement = true}}, 4).image);
    EXPECT_EQ(compare_images(pictures.back(), pictures.front()).differing_bits, 0u);
  }
}

TEST_F(HardCases, Case38_IntensitiesFromMillionthsToBillions) {
  Exactness check(yard(), width, height);
  std::vector<Light> lights = scattered(200, {-30, -1, -40}, {30, 12, 14}, 0.5f, 15, 38);
  for (size_t i = 0; i < lights.size(); ++i)
    lights[i].intensity = glm::vec3(1, 0.5f, 0.25f) * std::pow(10.0f, static_cast<float>(i % 16) - 6);
  check.expect_exact(camera_at({0, 3, 14}, {0, 1, -10}, width, height), lights);
}

TEST_F(HardCases, Case38_SumOfManyTinyContributions) {
  Exactness check(yard(), 16, 9, {.effects = {.spots = true}, .many_lights = true});
  std::vector<Light> lights;
  for (int i = 0; i < 65536; ++i)
    lights.push_back(omni({0.0001 * (i % 256), 4 + 0.0001 * (i / 256), 4}, 40, 1e-6f));
  lights.push_back(omni({0, 5, 3}, 40, 1));
  check.expect_exact(camera_at({0, 3, 14}, {0, 1, -10}, 16, 9), lights, {{.tile = 16}}, 4);
}

}  // namespace
}  // namespace ml::test
