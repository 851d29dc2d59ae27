// Rays against a scene's triangles on the CPU, in double: for camera paths and for the tests of scenes.
//
// Both sides of a triangle stop a ray, alpha masks are ignored (a leaf card is solid), triangles without area
// are never hit. Answers do not depend on the order of traversal: of equal distances the lowest triangle
// number wins.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

struct RayHit {
  double distance = 0;    // in lengths of the direction
  uint32_t triangle = 0;  // the three indices from 3 * triangle
  bool front = true;      // the ray meets the counter-clockwise side
};

class RayCaster {
 public:
  // Copies the triangles; the scene may go.
  explicit RayCaster(const Scene& scene);

  // The nearest hit with 0 < distance < limit. `direction` needs no unit length, but may not be 0.
  std::optional<RayHit> nearest(const glm::dvec3& origin, const glm::dvec3& direction,
                                double limit = std::numeric_limits<double>::infinity()) const;
  // Is nothing between `from` and `to`?
  bool clear(const glm::dvec3& from, const glm::dvec3& to) const { return !nearest(from, to - from, 1.0); }
  // The distance to the nearest hit, or `limit` if there is none nearer; `direction` of unit length.
  double free_length(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const {
    auto hit = nearest(origin, direction, limit);
    return hit ? hit->distance : limit;
  }

  // Unit normal of the counter-clockwise side.
  glm::dvec3 normal(uint32_t triangle) const;
  uint32_t triangle_count() const { return static_cast<uint32_t>(triangles_.size()); }

 private:
  struct Triangle {
    glm::dvec3 corner, edge1, edge2;
  };
  struct Node {
    glm::dvec3 min, max;
    uint32_t first = 0;  // leaf: index in order_; inner: the left child, the right one follows it
    uint32_t count = 0;  // triangles of a leaf, 0 for an inner node
  };

  void build(std::span<const glm::dvec3> centers);
  void bound(Node& node) const;

  std::vector<Triangle> triangles_;  // by triangle number
  std::vector<uint32_t> order_;      // triangle numbers, leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace ml
