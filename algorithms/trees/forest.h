// A forest of bounding interval trees, one for each tile or froxel, built bottom-up over lists of lights that
// are sorted by depth (Tiled Light Trees, sections 3.1 to 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/trees/forest_chunk.h"
#include "harness/base/parallel.h"

namespace ml {

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
  std::vector<ForestChunk> chunks_;
  size_t chunk_count_ = 0;
  std::vector<FroxelGrid::DepthRange> cell_depths_;
  std::vector<uint32_t> first_nodes_;
  uint64_t list_cells_ = 0, tree_cells_ = 0;
};

}  // namespace ml
