#include "algorithms/trees/forest.h"

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

void Forest::build(const FroxelLists& lists, const ForestSettings& settings, Threads& threads) {
  const uint32_t cells = lists.grid().cells();
  cell_depth_extents(lists.grid(), cell_depths_);
  first_nodes_.resize(cells + size_t{1});
  // Chunks of about as many list entries each, so that threads have alike work.
  chunk_count_ = threads.count() == 1 ? 1 : std::clamp<size_t>(cells / 64, 1, size_t{threads.count()} * 8);
  if (chunks_.size() < chunk_count_) chunks_.resize(chunk_count_);
  const auto offsets = lists.offsets();
  for (size_t c = 0; c < chunk_count_; ++c) {
    auto place = [&](size_t chunk) {
      if (chunk == chunk_count_) return cells;
      auto entry = static_cast<uint32_t>(lists.entries().size() * chunk / chunk_count_);
      return static_cast<uint32_t>(std::lower_bound(offsets.begin(), offsets.end() - 1, entry) -
                                   offsets.begin());
    };
    chunks_[c].first_cell = c == 0 ? 0 : place(c);
    chunks_[c].end_cell = place(c + 1);
  }
  threads.for_each(chunk_count_, [&](size_t c) {
    simd::build_chunk(lists, settings, cell_depths_, first_nodes_.data(), chunks_[c]);
  });
  size_t before = 0;
  list_cells_ = tree_cells_ = 0;
  for (size_t c = 0; c < chunk_count_; ++c) {
    const ForestChunk& chunk = chunks_[c];
    if (before > 0)
      for (uint32_t cell = chunk.first_cell; cell < chunk.end_cell; ++cell)
        first_nodes_[cell] += static_cast<uint32_t>(before);
    before += chunk.count;
    list_cells_ += chunk.list_cells;
    tree_cells_ += chunk.tree_cells;
  }
  first_nodes_[cells] = static_cast<uint32_t>(before);
}

void Forest::copy_nodes(TreeNode* to, Threads& threads) const {
  threads.for_each(chunk_count_, [&](size_t c) {
    const ForestChunk& chunk = chunks_[c];
    if (chunk.count > 0)
      std::memcpy(to + first_nodes_[chunk.first_cell], chunk.nodes.data(), chunk.count * sizeof(TreeNode));
  });
}

}  // namespace ml
