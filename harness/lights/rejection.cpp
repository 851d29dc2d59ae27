#include <cmath>

#include "harness/lights/set.h"

namespace ml {
namespace {

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool unit(const glm::vec3& v) {
  return std::abs(glm::dot(v, v) - 1) < 1e-3f;
}

const char* cone_reason(const Light& light) {
  if (!std::isfinite(light.inner_angle) || !std::isfinite(light.outer_angle))
    return "cone angle is not finite";
  if (light.outer_angle <= 0) return "outer cone angle is not above 0";
  if (light.outer_angle > 3.1415928f) return "outer cone angle is above pi";
  if (light.inner_angle < 0) return "inner cone angle is negative";
  if (light.inner_angle > light.outer_angle) return "inner cone angle is above the outer";
  return nullptr;
}

const char* segment_reason(const Light& light) {
  if (!std::isfinite(light.half_length)) return "half length is not finite";
  if (light.half_length < 0) return "half length is negative";
  if (light.half_length > kMaxLightRadius) return "half length is above 1e12 m";
  return nullptr;
}

const char* box_reason(const Light& light) {
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = light.half_extents[axis];
    if (!std::isfinite(extent)) return "half extent is not finite";
    if (extent < 0) return "half extent is negative";
    if (extent == 0) return "half extent is 0";
    if (extent < kMinLightRadius) return "half extent is below 1e-12 m";
  }
  const double diagonal = glm::length(glm::dvec3(light.half_extents));
  if (!(std::abs(diagonal - double{light.radius}) <= 1e-3 * diagonal))
    return "radius is not the box's half diagonal";
  return nullptr;
}

const char* axes_reason(const Light& light) {
  if (light.shape != LightShape::capsule) {
    if (!finite(light.direction)) return "direction is not finite";
    if (!unit(light.direction)) return "direction is not of unit length";
  }
  if (light.shape == LightShape::spot) return nullptr;
  if (!finite(light.side)) return "side is not finite";
  if (!unit(light.side)) return "side is not of unit length";
  if (light.shape != LightShape::capsule && !(std::abs(glm::dot(light.side, light.direction)) < 1e-3f))
    return "side is not across the direction";
  return nullptr;
}

}  // namespace

const char* rejection_reason(const Light& light) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(light.position[axis])) return "position is not finite";
    if (std::abs(light.position[axis]) > kMaxLightPosition) return "position is beyond 1e12 m";
  }
  // First, because a box has its radius from its extents.
  const bool box = light.shape == LightShape::box;
  if (const char* reason = box ? box_reason(light) : nullptr) return reason;
  if (!std::isfinite(light.radius)) return "radius is not finite";
  if (light.radius < 0) return "radius is negative";
  if (light.radius == 0) return "radius is 0";
  if (light.radius < kMinLightRadius) return "radius is below 1e-12 m";
  if (light.radius > kMaxLightRadius) return "radius is above 1e12 m";
  if (!finite(light.intensity)) return "intensity is not finite";
  if (light.intensity.x < 0 || light.intensity.y < 0 || light.intensity.z < 0) return "intensity is negative";
  if (light.shape == LightShape::omni) return nullptr;
  if (const char* reason = axes_reason(light)) return reason;
  if (const char* reason = has_segment(light.shape) ? segment_reason(light) : nullptr) return reason;
  return has_cone(light.shape) ? cone_reason(light) : nullptr;
}

}  // namespace ml
