// A forest of bounding interval trees, one for each tile or froxel, built bottom-up over lists of lights that
// are sorted by depth (Tiled Light Trees, sections 3.1 to 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/trees/tree_node.h"
#include "harness/base/parallel.h"

namespace ml {

struct ForestSettings {
  uint32_t lights_per_leaf = 8;  // [1, 64]; raised where a tree would have more leaves than its fields hold
  // Listing 2: a cell becomes a tree when the mean of its lights' depth extents, clipped to the cell, is
  // below this part of the cell's own extent; else a list. Infinite: always a tree. 0: always a list.
  float threshold = 1;
  // Leave out the nodes behind the last leaf that has lights: only padding.
  bool trim_padding = true;
};

// One-node trees stand for lists (section 3.4); a list of more lights than a leaf holds is several such nodes
// one after the other.
class Forest {
 public:
  void build(const FroxelLists& lists, const ForestSettings& settings, Threads& threads);

  // Where each cell's nodes begin, and one more: the end of the last.
  std::span<const uint32_t> first_nodes() const { return first_nodes_; }
  uint64_t nodes() const { return first_nodes_.empty() ? 0 : first_nodes_.back(); }
  // Writes all nodes; `to` has nodes() elements.
  void copy_nodes(gpu_data::TreeNode* to, Threads& threads) const;

  // Cells with lights that are a list (one leaf) or a tree.
  uint64_t list_cells() const { return list_cells_; }
  uint64_t tree_cells() const { return tree_cells_; }

 private:
  // A run of neighbouring cells, worked on by one thread at a time.
  struct Chunk {
    std::vector<gpu_data::TreeNode> nodes;
    std::vector<float> low, high;  // a tree's bounds, level by level
    size_t count = 0;              // of nodes
    uint32_t first_cell = 0, end_cell = 0;
    uint64_t list_cells = 0, tree_cells = 0;
  };
  void build_chunk(const FroxelLists& lists, const ForestSettings& settings, Chunk& chunk);

  std::vector<Chunk> chunks_;
  size_t chunk_count_ = 0;
  std::vector<FroxelGrid::DepthRange> cell_depths_;
  std::vector<uint32_t> first_nodes_;
  uint64_t list_cells_ = 0, tree_cells_ = 0;
};

// Lights in a leaf of a tree over `lights` lights: as asked, or as many as the largest tree needs, in eights.
uint32_t leaf_size(uint32_t asked, uint32_t lights);

// Depth extents (m) of a cell of each slice, as listing 2 takes them: from the near plane to the far depth,
// whatever lies beyond in the last slice.
void cell_depth_extents(const FroxelGrid& grid, std::vector<FroxelGrid::DepthRange>& extents);

// Place of a node in a full binary tree of 2^height leaves stored depth first: node `index` of level `level`
// (the root is level 0).
uint32_t depth_first_place(uint32_t height, uint32_t level, uint32_t index);

}  // namespace ml
