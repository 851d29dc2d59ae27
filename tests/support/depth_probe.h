// What a camera sees, by rays: for tests of scenes and paths.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

#include "harness/scene/camera.h"
#include "harness/scene/ray_caster.h"

namespace ml {

struct DepthProbe {
  std::vector<double> depths;  // m along the view direction, ascending; pixels that see nothing are left out
  std::vector<glm::dvec3> points;          // m, where the rays end, in the order of the pixels
  double nearest = 1e9;                    // m, along the rays
  uint32_t back_sides = 0;                 // pixels that see a triangle from behind
  std::vector<uint32_t> seen_from_behind;  // these triangles, by pixel

  // The depth below which `share` of the pixels with something in them lie.
  double quantile(double share) const {
    return depths.empty() ? 0 : depths[static_cast<size_t>(share * static_cast<double>(depths.size() - 1))];
  }
};

// The ray through the middle of a pixel; its length is 1 along the view direction.
inline glm::dvec3 pixel_ray(const Camera& camera, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const Projection& p = camera.projection;
  double sx = p.left + (p.right - p.left) * ((x + 0.5) / width);
  double sy = p.top - (p.top - p.bottom) * ((y + 0.5) / height);
  return glm::dvec3(camera.forward) + sx * glm::dvec3(camera.right) + sy * glm::dvec3(camera.up);
}

inline DepthProbe probe(const RayCaster& rays, const Camera& camera, uint32_t width = 64,
                        uint32_t height = 36) {
  DepthProbe result;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      glm::dvec3 direction = pixel_ray(camera, x, y, width, height);
      auto hit = rays.nearest(glm::dvec3(camera.position), direction);
      if (!hit) continue;
      result.depths.push_back(hit->distance);
      result.points.push_back(glm::dvec3(camera.position) + hit->distance * direction);
      result.nearest = std::min(result.nearest, hit->distance * glm::length(direction));
      if (!hit->front) {
        ++result.back_sides;
        result.seen_from_behind.push_back(hit->triangle);
      }
    }
  }
  std::sort(result.depths.begin(), result.depths.end());
  return result;
}

}  // namespace ml
