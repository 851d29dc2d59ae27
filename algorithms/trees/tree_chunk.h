// Trees and lists of a run of neighbouring cells: the part of the build that one thread does at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/trees/tree_node.h"

namespace ml {

struct TreeSettings {
  uint32_t lights_per_leaf = 8;  // [1, 64]; raised where a tree would have more leaves than its fields hold
  // A cell of no more lights than this is a list, as are those whose lights are one leaf's: to walk a tree
  // costs about as much as to test so many lights.
  uint32_t list_lights = 0;
  // Listing 2: a cell becomes a tree when the mean of its lights' depth extents, clipped to the cell, is
  // below this part of the cell's own extent; else a list. Infinite: always a tree. 0: always a list.
  float threshold = 1;
  // The mean is of extents clipped to the cell, as in listing 2; false: of whole ones, as in the authors'
  // code, each counted as at most max_extents of the cell's.
  bool clipped = true;
  // Leave out the nodes after the last leaf that has lights: only padding.
  bool trim_padding = true;
  // Lists are trees of one node, as in the paper (section 3.4), or several one after the other where a leaf
  // cannot count them; else its cell says where a list is.
  bool list_nodes = false;
  // Cells of no more lights are lists whatever their depths.
  uint32_t short_list() const { return std::max(lights_per_leaf, list_lights); }
};

struct TreeChunk {
  uint32_t first_cell = 0, end_cell = 0;
  gpu_data::TreeNode* nodes = nullptr;  // space for node_capacity() of them
  size_t count = 0;                     // of nodes written
  uint64_t first_node = 0;              // of all nodes
  uint64_t list_cells = 0, tree_cells = 0;
  size_t node_cells = 0;             // cells that have nodes
  std::vector<uint32_t> node_tiles;  // and the tile of each
  // Scratch: the depths of the lights in one row of froxels, and the bounds of one cell's tree level by
  // level.
  std::vector<DepthReach> reaches, bounds;
};

namespace simd {
// Builds the cells of the chunk into cells[cell]; nodes are numbered by their index in chunk.nodes.
// `cell_depths`: of each slice (cell_depth_extents()).
void build_chunk(const FroxelLists& lists, const TreeSettings& settings,
                 std::span<const FroxelGrid::DepthRange> cell_depths, gpu_data::TreeCell* cells,
                 TreeChunk& chunk);
}  // namespace simd

// Lights in a leaf of a tree over `lights` lights: as asked, or as many as the largest tree needs, in eights.
inline uint32_t leaf_size(uint32_t asked, uint32_t lights) {
  if (lights <= asked * ML_TREE_MAX_LEAVES) return asked;
  return (lights + 8 * ML_TREE_MAX_LEAVES - 1) / (8 * ML_TREE_MAX_LEAVES) * 8;
}

// Nodes that cells take at most; `offsets`: where their lists begin, and the end. A tree of u > 1 leaves has
// more lights than u - 1 leaves hold, and with its padding less than 4 (u - 1) nodes.
inline uint64_t node_capacity(const TreeSettings& settings, std::span<const uint32_t> offsets) {
  uint32_t in_long_lists = 0;
  for (size_t cell = 0; cell + 1 < offsets.size(); ++cell) {
    const uint32_t lights = offsets[cell + 1] - offsets[cell];
    in_long_lists += lights > settings.short_list() ? lights : 0;
  }
  return uint64_t{4} * (in_long_lists / settings.lights_per_leaf + 1) +
         (settings.list_nodes ? offsets.size() : 0);
}

// Index of a node in a full binary tree of 2^height leaves stored depth first: node `index` of level `level`
// (the root is level 0). Before it stand its ancestors and the whole subtrees to their left: for every set
// bit of the index one of 2^(height - level + bit + 1) - 1 nodes. Always inlined, for the instructions of the
// caller's target.
[[gnu::always_inline]] inline uint32_t depth_first_index(uint32_t height, uint32_t level, uint32_t index) {
  return level + (index << (height - level + 1)) - static_cast<uint32_t>(std::popcount(index));
}

// Depth extents (m) of a cell of each slice, as listing 2 takes them: from the near plane to the far depth,
// whatever lies beyond in the last slice.
void cell_depth_extents(const FroxelGrid& grid, std::vector<FroxelGrid::DepthRange>& extents);

// Listing 2 sums in steps of 1/65536 of the cell's extent, so that the sum is the same in any order. Steps a
// metre; 0 for a cell without extent.
inline float extent_steps(FroxelGrid::DepthRange extent) {
  return extent.high > extent.low ? 65536.0f / (extent.high - extent.low) : 0.0f;
}
// An extent of 16 cells, in the steps of the sum, can be added in single precision, and a cell whose mean is
// beyond that is a list by any threshold that chooses.
inline constexpr float max_extents = 16;
// Whether the mean of `lights` extents, which sum up to `sum` steps, is below the threshold.
inline bool is_tree(uint64_t sum, uint32_t lights, float threshold) {
  return static_cast<double>(sum) < static_cast<double>(threshold) * 65536.0 * lights;
}

}  // namespace ml
