// Which points can be walked between in a straight line, and the ways over them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/camera/floor_points.h"
#include "harness/scene/ray_caster.h"

namespace ml {

// Can the visitor go straight from eye position `a` to `b`? (Rays at eye and waist, and beside the eye.)
bool walkable(const RayCaster& rays, const glm::dvec3& a, const glm::dvec3& b, const Stature& stature);

class WalkGraph {
 public:
  WalkGraph(const RayCaster& rays, const std::vector<FloorPoint>& points, const Stature& stature);

  // The points of the largest part that hangs together, in ascending order.
  const std::vector<uint32_t>& largest_part() const { return largest_; }
  // The length of the shortest way from `from` to every point, infinity where there is none; `previous` gets
  // the way back.
  std::vector<double> distances(uint32_t from, std::vector<uint32_t>& previous) const;
  // The points of the shortest way, both ends included.
  std::vector<uint32_t> way(uint32_t from, uint32_t to) const;

 private:
  struct Edge {
    uint32_t to;
    double length;
  };
  std::vector<std::vector<Edge>> edges_;
  std::vector<uint32_t> largest_;
};

}  // namespace ml
