// A tree over the volumes of lights with 2 to 8 children a node, kept from frame to frame: built afresh by
// the surface area heuristic, or refitted to where lights have moved and repaired by inserting some of them
// anew (after J. Bittner, M. Hapala, V. Havran, "Fast Insertion-Based Optimization of Bounding Volume
// Hierarchies", CGF 32(1), 2013, which the post's reference [1] is; there the worst nodes are chosen, here
// every light in its turn).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/light_bvh/light_volumes.h"

namespace ml {

class SphereTree {
 public:
  static constexpr uint32_t max_children = 8, none = 0xffffffffu;

  struct Node {
    VolumeBox box;
    uint32_t parent = none;
    uint32_t light = none;  // leaf
    uint32_t children = 0;
    std::array<uint32_t, max_children> child{};
  };

  explicit SphereTree(uint32_t branching) : branching_(branching) {}

  // A fresh tree: binned surface area heuristic, binary, then the largest children opened until a node is
  // full.
  void build(const FrameLights& lights);
  // The tree for the lights as they are now: lights that went (by identity) are taken out, those that stayed
  // get new bounds, those that came are inserted where each costs least. Built afresh when more came and went
  // than stayed; a tree that was never built has no lights.
  void follow(const FrameLights& lights);
  // Takes lights out whose identity is first, first + stride, ... and inserts each where it costs least.
  void reinsert(uint32_t first, uint32_t stride);

  uint32_t root() const { return root_; }  // none: no lights
  uint32_t lights() const { return lights_; }
  const Node& operator[](uint32_t node) const { return nodes_[node]; }
  // Of a light of the last build() or follow().
  const LightVolume& volume(uint32_t light) const { return volumes_[light]; }
  // Nodes, children before their parent.
  const std::vector<uint32_t>& bottom_up() const { return order_; }

 private:
  uint32_t new_node();
  uint32_t build_range(const FrameLights& lights, uint32_t begin, uint32_t end, uint32_t depth);
  void collapse(uint32_t node);
  void refit();
  void remove(uint32_t leaf);
  void insert(uint32_t leaf);
  void fit(uint32_t node);
  void list_bottom_up();

  uint32_t branching_;
  uint32_t root_ = none, lights_ = 0;
  std::vector<Node> nodes_;
  std::vector<LightVolume> volumes_;
  std::vector<uint32_t> free_, leaf_of_light_ /* by identity */, items_, right_items_, order_, stack_;
};

}  // namespace ml
