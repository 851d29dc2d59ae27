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
  auto scale = [factor](float& size) { size = static_cast<float>(double{size} * factor); };
  scale(light.radius);
  if (has_segment(light.shape)) scale(light.half_length);
  if (light.shape == LightShape::box)
    for (int axis = 0; axis < 3; ++axis) scale(light.half_extents[axis]);
}

}  // namespace ml
