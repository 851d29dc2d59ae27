// Lights as the scene has them: shape, place, radius of influence and radiant intensity.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace ml {

// The values are part of the GPU format (shaders/shared/light.h).
enum class LightShape : uint32_t { omni = 0, spot = 1 };

struct Light {
  glm::dvec3 position{0};  // m, relative to Scene::origin
  float radius = 1;        // m, > 0: no contribution at or beyond this distance
  glm::vec3 intensity{1};  // W/sr per colour channel, >= 0
  LightShape shape = LightShape::omni;
  glm::vec3 direction{0, -1, 0};  // unit; spots: the axis, away from the light
  float inner_angle = 0;          // radians; spots: half-angle inside which the cone factor is 1
  float outer_angle =
      0.7853982f;  // radians, (inner_angle, pi]; spots: half-angle at and beyond which it is 0
};

}  // namespace ml
