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
  std::vector<glm::dvec3> points;  // m, where the rays end, in the order of the pixels
  double nearest = 1e9;            // m, along the rays
  uint32_t back_sides = 0;         // pixels that see a triangle from behind

  // The depth below which `share` of the pixels with something in them lie.
  double quantile(double share) const {
    return depths.empty() ? 0 : depths[static_cast<size_t>(share * static_cast<double>(depths.size() - 1))];
  }
};

inline DepthProbe probe(const RayCaster& rays, const Camera& camera, uint32_t width = 64,
                        uint32_t height = 36) {
  DepthProbe result;
  const Projection& p = camera.projection;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      double sx = p.left + (p.right - p.left) * ((x + 0.5) / width);
      double sy = p.top - (p.top - p.bottom) * ((y + 0.5) / height);
      glm::dvec3 direction =
          glm::dvec3(camera.forward) + sx * glm::dvec3(camera.right) + sy * glm::dvec3(camera.up);
      auto hit = rays.nearest(glm::dvec3(camera.position), direction);
      if (!hit) continue;
      result.depths.push_back(hit->distance);
      result.points.push_back(glm::dvec3(camera.position) + hit->distance * direction);
      result.nearest = std::min(result.nearest, hit->distance * glm::length(direction));
      result.back_sides += hit->front ? 0 : 1;
    }
  }
  std::sort(result.depths.begin(), result.depths.end());
  return result;
}

}  // namespace ml
