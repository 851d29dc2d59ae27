// A cell_trees of bounding interval trees, one for each tile or froxel, built bottom-up over lists of lights that
// are sorted by depth (Tiled Light Trees, sections 3.1 to 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/trees/tree_chunk.h"
#include "harness/base/parallel.h"

namespace ml {

class CellTrees {
 public:
  // Nodes that the lists' trees take at most.
  static uint64_t capacity(const FroxelLists& lists, const TreeSettings& settings) {
    return node_capacity(settings, lists.offsets());
  }

  // With `in_place`, of capacity() elements, a single thread writes the nodes there; else they are in memory of their
  // own. copy_nodes() sees to it that they are there.
  void build(const FroxelLists& lists, const TreeSettings& settings, Threads& threads,
             gpu_data::TreeNode* in_place = nullptr);

  std::span<const gpu_data::TreeCell> cells() const { return cells_; }
  uint64_t nodes() const { return nodes_; }
  // Writes all nodes; `to` has nodes() elements, or is where they were built.
  void copy_nodes(gpu_data::TreeNode* to, Threads& threads) const;

  // Cells with lights that are a list or a tree.
  uint64_t list_cells() const { return list_cells_; }
  uint64_t tree_cells() const { return tree_cells_; }
  // Sets the elements of the tiles that have nodes in some slice to 1.
  void mark_node_tiles(std::span<uint8_t> tiles) const;

 private:
  std::vector<TreeChunk> chunks_;
  std::vector<std::vector<gpu_data::TreeNode>> own_nodes_;  // of each chunk
  size_t chunk_count_ = 0;
  std::vector<FroxelGrid::DepthRange> cell_depths_;
  std::vector<gpu_data::TreeCell> cells_;
  uint64_t nodes_ = 0;
  uint64_t list_cells_ = 0, tree_cells_ = 0;
};

}  // namespace ml
