#include "random_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/lights/set.h"

namespace ml::test {

glm::vec3 any_direction(Random& random) {
  glm::vec3 v;
  do {
    v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (glm::length(v) < 0.1f);
  return glm::normalize(v);
}

std::vector<Light> random_shapes(uint32_t count, Random& random) {
  std::vector<Light> lights(count);
  for (uint32_t i = 0; i < count; ++i) {
    Light& light = lights[i];
    light.position = {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)};
    light.shape = static_cast<LightShape>(i % 5);
    light.radius = std::pow(10.0f, random.uniform(-4, 4));
    light.direction = any_direction(random);
    light.side = glm::normalize(glm::cross(light.direction, any_direction(random)));
    light.outer_angle =
        3.14159f * (random.below(2) ? random.uniform() : std::pow(10.0f, random.uniform(-3, 0)));
    light.inner_angle = 0.5f * light.outer_angle;
    light.half_length = random.below(4) ? std::pow(10.0f, random.uniform(-4, 4)) : 0;
    if (light.shape == LightShape::box)
      make_box(light, {std::pow(10.0f, random.uniform(-3, 3)), std::pow(10.0f, random.uniform(-3, 3)),
                       std::pow(10.0f, random.uniform(-3, 3))});
    EXPECT_EQ(rejection_reason(light), nullptr) << rejection_reason(light);
  }
  return lights;
}

glm::dvec3 random_point_in(Random& random, const Light& light) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(light.direction)),
                   side = glm::normalize(glm::dvec3(light.side)), up = glm::cross(axis, side);
  // -1 .. 1, and often one of them.
  const auto share = [&] { return std::clamp(random.uniform(-1.5f, 1.5f), -1.0f, 1.0f); };
  if (light.shape == LightShape::box)
    return light.position + side * double{share() * light.half_extents.x} +
           up * double{share() * light.half_extents.y} + axis * double{share() * light.half_extents.z};
  const double widest = has_cone(light.shape) ? double{light.outer_angle} : 3.141592653589793;
  const double angle = widest * (0.5 + 0.5 * double{share()}),
               turn = 6.283185307179586 * double{random.uniform()};
  const glm::dvec3 ray =
      axis * std::cos(angle) + (side * std::cos(turn) + up * std::sin(turn)) * std::sin(angle);
  const double along = has_segment(light.shape) ? double{share() * light.half_length} : 0.0;
  return light.position + side * along + ray * (double{light.radius} * (0.5 + 0.5 * double{share()}));
}

}  // namespace ml::test
