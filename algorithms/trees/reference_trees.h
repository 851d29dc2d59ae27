// Light trees as the paper describes them (Tiled Light Trees, sections 3.1 to 3.3), in plain scalar code: one
// array of structures, breadth first, then a conversion table to depth first. The oracle of the fast path's
// tests and the baseline of its benchmark.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/trees/cell_trees.h"
#include "algorithms/trees/tree_node.h"

namespace ml {

class ReferenceTrees {
 public:
  void build(const ReferenceLists& lists, const TreeSettings& settings);

  const std::vector<gpu_data::TreeCell>& cells() const { return cells_; }
  const std::vector<gpu_data::TreeNode>& nodes() const { return nodes_; }
  // Light indices of all lists, as the GPU has them.
  const std::vector<uint32_t>& lights() const { return lights_; }

 private:
  struct Node {
    float low, high;
    uint32_t first, lights, skip;
    bool leaf;
  };
  bool wants_tree(const ReferenceLists& lists, uint32_t cell, const TreeSettings& settings) const;
  void build_tree(const ReferenceLists& lists, uint32_t cell, uint32_t per_leaf, bool trim);
  void append(const Node& node);

  std::vector<FroxelGrid::DepthRange> cell_depths_;
  std::vector<std::vector<uint32_t>>
      tables_;              // [height]: of each node in depth-first order, its breadth-first index
  std::vector<Node> tree_;  // breadth first
  std::vector<gpu_data::TreeCell> cells_;
  std::vector<uint32_t> lights_;
  std::vector<gpu_data::TreeNode> nodes_;
};

}  // namespace ml
