#include "algorithms/trees/cell_trees.h"

#include <algorithm>
#include <cstring>

namespace ml {

using gpu_data::TreeNode;

void cell_depth_extents(const FroxelGrid& grid, std::vector<FroxelGrid::DepthRange>& extents) {
  grid.slice_ranges(extents);
  extents.front().low = grid.near;
  extents.back().high = grid.far;
  for (FroxelGrid::DepthRange& extent : extents) extent.high = std::max(extent.high, extent.low);
}

void CellTrees::build(const FroxelLists& lists, const TreeSettings& settings, Threads& threads,
                      TreeNode* in_place) {
  const uint32_t cells = lists.grid().cells();
  cell_depth_extents(lists.grid(), cell_depths_);
  cells_.resize(cells);
  // Chunks of about as many list entries each, so that threads have alike work.
  chunk_count_ = threads.count() == 1 ? 1 : std::clamp<size_t>(cells / 64, 1, size_t{threads.count()} * 8);
  if (chunks_.size() < chunk_count_) {
    chunks_.resize(chunk_count_);
    own_nodes_.resize(chunk_count_);
  }
  const auto offsets = lists.offsets();
  for (size_t c = 0; c < chunk_count_; ++c) {
    auto first_cell = [&](size_t chunk) {
      if (chunk == chunk_count_) return cells;
      auto entry = static_cast<uint32_t>(lists.entries().size() * chunk / chunk_count_);
      return static_cast<uint32_t>(std::lower_bound(offsets.begin(), offsets.end() - 1, entry) -
                                   offsets.begin());
    };
    chunks_[c].first_cell = c == 0 ? 0 : first_cell(c);
    chunks_[c].end_cell = first_cell(c + 1);
  }
  threads.for_each(chunk_count_, [&](size_t c) {
    TreeChunk& chunk = chunks_[c];
    if (chunk_count_ == 1 && in_place) {
      chunk.nodes = in_place;
    } else {
      const size_t cells_of_chunk = chunk.end_cell - chunk.first_cell;
      reserve_padded(own_nodes_[c],
                     node_capacity(settings, offsets.subspan(chunk.first_cell, cells_of_chunk + 1)));
      chunk.nodes = own_nodes_[c].data();
    }
    simd::build_chunk(lists, settings, cell_depths_, cells_.data(), chunk);
  });
  nodes_ = list_cells_ = tree_cells_ = 0;
  for (size_t c = 0; c < chunk_count_; ++c) {
    TreeChunk& chunk = chunks_[c];
    chunk.first_node = nodes_;
    nodes_ += chunk.count;
    list_cells_ += chunk.list_cells;
    tree_cells_ += chunk.tree_cells;
  }
  threads.for_each(chunk_count_, [&](size_t c) {
    const TreeChunk& chunk = chunks_[c];
    const auto before = static_cast<uint32_t>(chunk.first_node);
    if (before == 0) return;
    for (uint32_t cell = chunk.first_cell; cell < chunk.end_cell; ++cell) {
      gpu_data::TreeCell& node = cells_[cell];
      const uint32_t shift = node.end == 0 || (node.end & ML_TREE_CELL_LIST) != 0 ? 0 : before;
      node.first += shift;
      node.end += shift;
    }
  });
}

void CellTrees::mark_node_tiles(std::span<uint8_t> tiles) const {
  for (size_t c = 0; c < chunk_count_; ++c)
    for (uint32_t tile : std::span(chunks_[c].node_tiles).first(chunks_[c].node_cells)) tiles[tile] = 1;
}

void CellTrees::copy_nodes(TreeNode* to, Threads& threads) const {
  threads.for_each(chunk_count_, [&](size_t c) {
    const TreeChunk& chunk = chunks_[c];
    if (chunk.count > 0 && chunk.nodes != to)
      std::memcpy(to + chunk.first_node, chunk.nodes, chunk.count * sizeof(TreeNode));
  });
}

}  // namespace ml
