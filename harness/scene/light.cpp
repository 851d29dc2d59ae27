#include "harness/scene/light.h"

#include <cmath>

namespace ml {

const std::vector<std::string>& light_shape_names() {
  static const std::vector<std::string> names{"omni", "spot", "capsule", "wedge", "box"};
  return names;
}

void make_box(Light& light, const glm::vec3& half_extents) {
  light.shape = LightShape::box;
  light.half_extents = half_extents;
  light.radius = static_cast<float>(glm::length(glm::dvec3(half_extents)));
}

bool place_on_node(Light& light, const glm::dmat4& world) {
  auto usable = [](const glm::dvec3& axis) {
    const double length = glm::length(axis);
    return length > 1e-150 && std::isfinite(length);
  };
  const glm::dvec3 x(world[0]), y(world[1]), z(world[2]);
  if (!usable(x) && !usable(y) && !usable(z)) return false;
  const bool has_direction = has_cone(light.shape) || light.shape == LightShape::box;
  const bool has_side = has_segment(light.shape) || light.shape == LightShape::box;
  glm::dvec3 direction(0), side(0);
  if (has_direction) {
    if (!usable(z)) return false;
    direction = -z / glm::length(z);
  }
  if (has_side) {
    if (!usable(x)) return false;
    side = x / glm::length(x);
    side -= glm::dot(side, direction) * direction;
    if (!usable(side)) return false;
    side /= glm::length(side);
  }
  light.position = glm::dvec3(world[3]);
  if (has_direction) light.direction = glm::vec3(direction);
  if (has_side) light.side = glm::vec3(side);
  return true;
}

void scale_size(Light& light, double factor) {
  auto scaled = [factor](float size) { return static_cast<float>(double{size} * factor); };
  light.radius = scaled(light.radius);
  if (has_segment(light.shape)) light.half_length = scaled(light.half_length);
  if (light.shape == LightShape::box) {
    const glm::vec3& half = light.half_extents;
    make_box(light, {scaled(half.x), scaled(half.y), scaled(half.z)});
  }
}

}  // namespace ml
