#include "algorithms/trees/forest.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace ml {
namespace {

using gpu_data::TreeNode;

constexpr float infinity = std::numeric_limits<float>::infinity();

uint32_t packed(bool leaf, uint32_t lights, uint32_t skip) {
  assert(lights <= ML_TREE_MAX_LEAF_LIGHTS && skip < 1u << 15);
  return (leaf ? ML_TREE_LEAF : 0) | lights << ML_TREE_COUNT_SHIFT | skip << ML_TREE_SKIP_SHIFT;
}

// Depth bounds of the lights of `ranks`.
FroxelGrid::DepthRange bounds_of(std::span<const uint32_t> ranks, const DepthRanges& depths) {
  FroxelGrid::DepthRange range{infinity, -infinity};
  for (uint32_t rank : ranks) {
    range.low = std::min(range.low, depths.low[rank]);
    range.high = std::max(range.high, depths.high[rank]);
  }
  return range;
}

// Leaves one after the other: what a list is, and a tree of one leaf.
size_t write_list(std::span<const uint32_t> ranks, uint32_t first, const DepthRanges& depths,
                  TreeNode* nodes) {
  size_t count = 0;
  for (size_t begin = 0; begin < ranks.size(); begin += ML_TREE_MAX_LEAF_LIGHTS) {
    auto part = ranks.subspan(begin, std::min<size_t>(ranks.size() - begin, ML_TREE_MAX_LEAF_LIGHTS));
    FroxelGrid::DepthRange range = bounds_of(part, depths);
    nodes[count++] = {range.low, range.high, first + static_cast<uint32_t>(begin),
                      packed(true, static_cast<uint32_t>(part.size()), 1)};
  }
  return count;
}

}  // namespace

uint32_t depth_first_place(uint32_t height, uint32_t level, uint32_t index) {
  // Before it stand its ancestors and the whole subtrees to their left: for every set bit of the index one of
  // 2^(height - level + bit + 1) - 1 nodes.
  return level + (index << (height - level + 1)) - static_cast<uint32_t>(std::popcount(index));
}

uint32_t leaf_size(uint32_t asked, uint32_t lights) {
  if (lights <= asked * ML_TREE_MAX_LEAVES) return asked;
  return (lights + 8 * ML_TREE_MAX_LEAVES - 1) / (8 * ML_TREE_MAX_LEAVES) * 8;
}

void cell_depth_extents(const FroxelGrid& grid, std::vector<FroxelGrid::DepthRange>& extents) {
  grid.slice_ranges(extents);
  extents.front().low = grid.near;
  extents.back().high = grid.far;
  for (FroxelGrid::DepthRange& extent : extents) extent.high = std::max(extent.high, extent.low);
}

namespace {

// Bottom-up: leaves, then every level from the one below it; each node goes to its depth-first place. Returns
// the number of nodes.
size_t write_tree(std::span<const uint32_t> ranks, uint32_t first, const DepthRanges& depths,
                  uint32_t per_leaf, bool trim, std::vector<float>& low, std::vector<float>& high,
                  TreeNode* nodes) {
  const auto lights = static_cast<uint32_t>(ranks.size());
  const uint32_t used = (lights + per_leaf - 1) / per_leaf, leaves = std::bit_ceil(used);
  const auto height = static_cast<uint32_t>(std::countr_zero(leaves));
  assert(leaves <= ML_TREE_MAX_LEAVES);
  if (low.size() < leaves) {
    low.resize(leaves);
    high.resize(leaves);
  }
  for (uint32_t leaf = 0; leaf < used; ++leaf) {
    const uint32_t begin = leaf * per_leaf, count = std::min(per_leaf, lights - begin);
    FroxelGrid::DepthRange range = bounds_of(ranks.subspan(begin, count), depths);
    low[leaf] = range.low;
    high[leaf] = range.high;
    nodes[depth_first_place(height, height, leaf)] = {range.low, range.high, first + begin,
                                                      packed(true, count, 1)};
  }
  for (uint32_t leaf = used; leaf < leaves; ++leaf) {
    low[leaf] = infinity;
    high[leaf] = -infinity;
    nodes[depth_first_place(height, height, leaf)] = {infinity, -infinity, 0, packed(true, 0, 1)};
  }
  uint32_t lights_below = per_leaf;
  for (uint32_t level = height; level-- > 0;) {
    lights_below *= 2;
    const uint32_t skip = (2u << (height - level)) - 1;
    for (uint32_t index = 0; index < 1u << level; ++index) {
      low[index] = std::min(low[2 * index], low[2 * index + 1]);
      high[index] = std::max(high[2 * index], high[2 * index + 1]);
      const uint32_t begin = std::min(index * lights_below, lights);
      nodes[depth_first_place(height, level, index)] = {
          low[index], high[index], std::min(lights_below, lights - begin), packed(false, 0, skip)};
    }
  }
  return trim ? depth_first_place(height, height, used - 1) + 1 : 2 * leaves - 1;
}

}  // namespace

void Forest::build_chunk(const FroxelLists& lists, const ForestSettings& settings, Chunk& chunk) {
  const DepthRanges& depths = lists.depth_of_rank();
  const uint32_t slices = lists.grid().slices;
  const auto offsets = lists.offsets();
  const auto entries = lists.entries();
  chunk.count = 0;
  chunk.list_cells = chunk.tree_cells = 0;
  uint32_t slice = chunk.first_cell % slices;
  for (uint32_t cell = chunk.first_cell; cell < chunk.end_cell;
       ++cell, slice = slice + 1 == slices ? 0 : slice + 1) {
    first_nodes_[cell] = static_cast<uint32_t>(chunk.count);
    const uint32_t first = offsets[cell], lights = offsets[cell + 1] - first;
    if (lights == 0) continue;
    const auto ranks = entries.subspan(first, lights);
    const uint32_t per_leaf = leaf_size(settings.lights_per_leaf, lights);
    bool tree = lights > per_leaf;
    if (tree && settings.threshold < infinity) {
      const FroxelGrid::DepthRange extent = cell_depths_[slice];
      float sum = 0;
      for (uint32_t rank : ranks)
        sum +=
            std::max(std::min(depths.high[rank], extent.high) - std::max(depths.low[rank], extent.low), 0.0f);
      tree = sum < settings.threshold * (extent.high - extent.low) * static_cast<float>(lights);
    }
    // Room for a full tree of twice the leaves, or the nodes of a list.
    const size_t room =
        chunk.count + (tree ? 4 * (size_t{lights} / per_leaf + 1) : lights / ML_TREE_MAX_LEAF_LIGHTS + 1);
    if (chunk.nodes.size() < room) chunk.nodes.resize(room + room / 2 + 64);
    TreeNode* nodes = &chunk.nodes[chunk.count];
    if (tree) {
      chunk.count +=
          write_tree(ranks, first, depths, per_leaf, settings.trim_padding, chunk.low, chunk.high, nodes);
      ++chunk.tree_cells;
    } else {
      chunk.count += write_list(ranks, first, depths, nodes);
      ++chunk.list_cells;
    }
  }
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
  threads.for_each(chunk_count_, [&](size_t c) { build_chunk(lists, settings, chunks_[c]); });
  size_t before = 0;
  list_cells_ = tree_cells_ = 0;
  for (size_t c = 0; c < chunk_count_; ++c) {
    const Chunk& chunk = chunks_[c];
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
    const Chunk& chunk = chunks_[c];
    if (chunk.count > 0)
      std::memcpy(to + first_nodes_[chunk.first_cell], chunk.nodes.data(), chunk.count * sizeof(TreeNode));
  });
}

}  // namespace ml
