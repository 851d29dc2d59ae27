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
