#include "algorithms/light_bvh/packing.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

// Rounding of camera-relative coordinates and of distances in the shader (as
// algorithms/froxels/froxel_grid.h).
float widened(const glm::vec3& center, float radius) {
  return radius * 1.00001f + 2e-6f * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z));
}

}  // namespace

void SpherePacking::pack(const SphereTree& tree, const FrameLights& lights, uint32_t node) {
  const SphereTree::Node& n = tree[node];
  if (n.light != SphereTree::none) {
    const glm::vec3 center(lights.x[n.light], lights.y[n.light], lights.z[n.light]);
    const auto next = static_cast<uint32_t>(nodes_.size() + 1);
    nodes_.push_back({center, widened(center, lights.radius[n.light]), next, n.light});
    return;
  }
  uint32_t kept = 0, only = 0;
  for (uint32_t c = 0; c < n.children; ++c)
    if (visible_below_[n.child[c]] > 0) ++kept, only = n.child[c];
  if (kept == 1) return pack(tree, lights, only);
  const size_t place = nodes_.size();
  nodes_.emplace_back();
  for (uint32_t c = 0; c < n.children; ++c)
    if (visible_below_[n.child[c]] > 0) pack(tree, lights, n.child[c]);
  // A ball around the balls of the children, which stand behind this node, each where the last one's miss
  // leads. Its centre is that of the box around them.
  const auto end = static_cast<uint32_t>(nodes_.size());
  glm::vec3 low(nodes_[place + 1].center - nodes_[place + 1].radius), high(low);
  for (uint32_t child = static_cast<uint32_t>(place) + 1; child < end; child = nodes_[child].miss) {
    low = glm::min(low, nodes_[child].center - nodes_[child].radius);
    high = glm::max(high, nodes_[child].center + nodes_[child].radius);
  }
  PackedNode packed;
  packed.center = low * 0.5f + high * 0.5f;
  for (uint32_t child = static_cast<uint32_t>(place) + 1; child < end; child = nodes_[child].miss)
    packed.radius =
        std::max(packed.radius, glm::distance(packed.center, nodes_[child].center) + nodes_[child].radius);
  packed.radius = widened(packed.center, packed.radius);
  packed.miss = end;
  packed.light = packed_inner;
  nodes_[place] = packed;
}

void SpherePacking::build(const SphereTree& tree, const FrameLights& lights,
                          std::span<const uint8_t> visible) {
  nodes_.clear();
  if (tree.root() == SphereTree::none) return;
  uint32_t highest = 0;
  for (uint32_t node : tree.bottom_up()) highest = std::max(highest, node);
  visible_below_.assign(highest + size_t{1}, 0);
  for (uint32_t node : tree.bottom_up()) {
    const SphereTree::Node& n = tree[node];
    if (n.light != SphereTree::none) visible_below_[node] = visible[n.light];
    for (uint32_t c = 0; c < n.children; ++c) visible_below_[node] += visible_below_[n.child[c]];
  }
  if (visible_below_[tree.root()] > 0) pack(tree, lights, tree.root());
}

}  // namespace ml
