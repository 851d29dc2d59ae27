// The tree as the GPU walks it: nodes depth first, branches without lights in view left out.
#pragma once

#include <span>
#include <vector>

#include "algorithms/light_bvh/sphere_tree.h"

namespace ml {

// 24 bytes, or 32 with padding; the next node after a hit is the one after it.
struct PackedNode {
  glm::vec3 center{0};  // m, camera-relative
  float radius = 0;     // m, widened by what rounding may take
  uint32_t miss = 0;    // next node when the point is outside
  uint32_t light = 0;   // leaf: light index; else packed_inner
};
static_assert(sizeof(PackedNode) == 24);
inline constexpr uint32_t packed_inner = 0xffffffffu;

class SpherePacking {
 public:
  // `visible`: a flag for each light.
  void build(const SphereTree& tree, std::span<const uint8_t> visible);
  std::span<const PackedNode> nodes() const { return nodes_; }

 private:
  // Returns the box around the visible lights below.
  VolumeBox pack(const SphereTree& tree, uint32_t node);

  std::vector<PackedNode> nodes_;
  std::vector<uint32_t> visible_below_;  // per tree node
};

}  // namespace ml
