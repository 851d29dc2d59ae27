// What the tree goes by for each light: the smallest ball (for wedges nearly) and the smallest box (world
// axes) around the volume that it lights. For cones the ball is far smaller than the one around their apex: 1
// / (2 cos a)^3 of it for a half-angle a up to 45 degrees.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/froxels/froxel_grid.h"

namespace ml {

// A ball's radius with what the rounding of coordinates around its centre and of distances in the shader may
// take, m.
inline float widened(const glm::vec3& center, double radius) {
  const double sum = static_cast<double>(std::abs(center.x) + std::abs(center.y) + std::abs(center.z));
  return static_cast<float>(radius * double{widen_relative} + double{widen_absolute} * sum);
}

struct VolumeBox {
  glm::vec3 low{0}, high{0};  // m, camera-relative
  float area() const {
    const glm::vec3 size = glm::max(high - low, glm::vec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

inline VolumeBox around(const VolumeBox& a, const VolumeBox& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

// A point that the light reaches lies in both; with single precision's errors counted in, of the light's data
// and of distances computed from it.
struct LightVolume {
  glm::vec3 center{0};  // m, camera-relative: of the ball
  float radius = 0;     // m
  VolumeBox box;
};

LightVolume volume_of(const FrameLights& lights, uint32_t light);

// Of all lights; takes memory only where there are more than ever before.
void find_volumes(const FrameLights& lights, std::vector<LightVolume>& volumes);

}  // namespace ml
