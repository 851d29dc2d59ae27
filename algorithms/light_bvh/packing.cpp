#include "algorithms/light_bvh/packing.h"

#include <algorithm>

namespace ml {
namespace {

// The ball that holds the balls of these nodes, which stand from index `first` on, around the middle of their
// box.
PackedNode around_balls(std::span<const PackedNode> nodes, uint32_t first) {
  const uint32_t end = first + static_cast<uint32_t>(nodes.size());
  const auto each = [&](auto&& take) {
    for (uint32_t node = first; node < end; node = nodes[node - first].miss) take(nodes[node - first]);
  };
  PackedNode ball;
  VolumeBox box{nodes[0].center - nodes[0].radius, nodes[0].center + nodes[0].radius};
  each([&](const PackedNode& n) { box = around(box, {n.center - n.radius, n.center + n.radius}); });
  ball.center = box.low * 0.5f + box.high * 0.5f;
  each([&](const PackedNode& n) {
    ball.radius = std::max(ball.radius, glm::distance(ball.center, n.center) + n.radius);
  });
  return ball;
}

PackedNode around_box(const VolumeBox& box) {
  PackedNode ball;
  ball.center = box.low * 0.5f + box.high * 0.5f;
  ball.radius = 0.5f * glm::distance(box.low, box.high);
  return ball;
}

}  // namespace

VolumeBox SpherePacking::pack(const SphereTree& tree, uint32_t node) {
  const SphereTree::Node& n = tree[node];
  if (n.light != SphereTree::none) {
    const LightVolume& volume = tree.volume(n.light);
    nodes_.push_back({volume.center, volume.radius, static_cast<uint32_t>(nodes_.size() + 1), n.light});
    return volume.box;
  }
  uint32_t kept = 0, only = 0;
  for (uint32_t c = 0; c < n.children; ++c)
    if (visible_below_[n.child[c]] > 0) ++kept, only = n.child[c];
  if (kept == 1) return pack(tree, only);
  const size_t index = nodes_.size();
  nodes_.emplace_back();
  VolumeBox box;
  bool first = true;
  for (uint32_t c = 0; c < n.children; ++c) {
    if (visible_below_[n.child[c]] == 0) continue;
    const VolumeBox child = pack(tree, n.child[c]);
    box = first ? child : around(box, child);
    first = false;
  }
  // The children stand after this node, each where the last one's miss leads.
  const std::span<const PackedNode> below = std::span(nodes_).subspan(index + 1);
  PackedNode packed = around_balls(below, static_cast<uint32_t>(index) + 1);
  if (const PackedNode ball = around_box(box); ball.radius < packed.radius) packed = ball;
  packed.radius = widened(packed.center, static_cast<double>(packed.radius));
  packed.miss = static_cast<uint32_t>(nodes_.size());
  packed.light = packed_inner;
  nodes_[index] = packed;
  return box;
}

void SpherePacking::build(const SphereTree& tree, std::span<const uint8_t> visible) {
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
  if (visible_below_[tree.root()] > 0) pack(tree, tree.root());
}

}  // namespace ml
