#include "tests/hard_cases/random_frames.h"

#include <fmt/format.h>

#include <cmath>

namespace ml::test {

float log_uniform(Random& random, float low, float high) {
  return low * std::pow(high / low, random.uniform());
}

Camera random_camera(Random& random, uint32_t width, uint32_t height) {
  const glm::dvec3 eye(static_cast<double>(random.uniform(-25, 25)),
                       static_cast<double>(log_uniform(random, 0.05f, 30)),
                       static_cast<double>(random.uniform(-30, 25)));
  const glm::dvec3 target = eye + glm::dvec3(static_cast<double>(random.uniform(-1, 1)),
                                             static_cast<double>(random.uniform(-1, 0.2f)),
                                             static_cast<double>(random.uniform(-1, 1)));
  const float aspect = static_cast<float>(width) / static_cast<float>(height),
              near = log_uniform(random, 1e-3f, 3);
  const float far = near + log_uniform(random, 1, 1e4f);
  Projection projection = Projection::perspective(random.uniform(5, 140) * degrees, aspect, near, far);
  if (random.below(4) == 0) {
    const float half = log_uniform(random, 0.5f, 60);
    projection = Projection::orthographic(half, half / aspect, near, far);
  }
  if (random.below(3) == 0) {
    const float across = (projection.right - projection.left) * random.uniform(-1, 1);
    const float up = (projection.top - projection.bottom) * random.uniform(-1, 1);
    projection.left += across, projection.right += across * random.uniform(0.5f, 1);
    projection.bottom += up, projection.top += up;
    if (!(projection.right > projection.left)) projection.right = projection.left + 0.1f;
  }
  return Camera::look_at(eye, target, projection);
}

std::vector<Light> random_lights(Random& random, const Camera& camera, uint32_t max_lights) {
  // Every number of lights, small ones as often as large ones; many are smaller, so that as many reach a
  // pixel.
  const auto count = static_cast<uint32_t>(log_uniform(random, 1, static_cast<float>(max_lights) + 1.5f)) - 1;
  const float largest = 40 * std::cbrt(std::min(1.0f, 400 / (static_cast<float>(count) + 1)));
  std::vector<Light> lights =
      random.below(2)
          ? scattered(count, {-40, -2, -45}, {40, 15, 30}, 0.02f, largest, random.next(), 1 + random.below(4))
          : mixed_shapes(count, {-40, -2, -45}, {40, 15, 30}, 0.02f, largest, random.next());
  // Some at and behind the camera, with the eye inside or just outside.
  for (uint32_t i = random.below(20); i > 0; --i) {
    const glm::vec3 off = (camera.forward * random.uniform(-1, 1) + camera.right * random.uniform(-1, 1) +
                           camera.up * random.uniform(-1, 1)) *
                          log_uniform(random, 0.01f, 20);
    lights.push_back(omni(glm::dvec3(camera.position + off),
                          std::max(1e-3f, glm::length(off) * random.uniform(0.9f, 1.1f))));
  }
  return lights;
}

void for_random_frames(uint32_t width, uint32_t height, uint32_t cases, uint32_t seed,
                       const CheckFrame& check, uint32_t max_lights) {
  uint64_t contributing = 0;
  for (uint32_t number = 0; number < cases && !testing::Test::HasFailure(); ++number) {
    SCOPED_TRACE(fmt::format("{}x{}, seed {}, case {}", width, height, seed, number));
    Random random(hash_u32(seed, number));
    const Camera camera = random_camera(random, width, height);
    const std::vector<Light> lights = random_lights(random, camera, max_lights);
    contributing += check(random, camera, lights);
  }
  EXPECT_GT(contributing, uint64_t{cases} * width * height / 20)
      << "the cases are too empty to mean anything";
}

}  // namespace ml::test
