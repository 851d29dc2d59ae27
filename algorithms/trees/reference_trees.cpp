#include "algorithms/trees/reference_trees.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ml {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Depth-first walk of a full binary tree whose nodes are numbered breadth first.
void list_depth_first(uint32_t node, uint32_t nodes, std::vector<uint32_t>& table) {
  if (node >= nodes) return;
  table.push_back(node);
  list_depth_first(2 * node + 1, nodes, table);
  list_depth_first(2 * node + 2, nodes, table);
}

}  // namespace

bool ReferenceTrees::wants_tree(const ReferenceLists& lists, uint32_t cell,
                                const TreeSettings& settings) const {
  if (settings.threshold == infinity) return true;
  const FroxelGrid::DepthRange extent = cell_depths_[cell / lists.grid().tiles()];
  const uint32_t begin = lists.offsets()[cell], end = lists.offsets()[cell + 1];
  uint64_t sum = 0;
  for (uint32_t i = begin; i < end; ++i) {
    const DepthInterval light = lists.depth_of_rank()[lists.entries()[i]];
    const float depth = settings.clipped ? std::min(light.high, extent.high) - std::max(light.low, extent.low)
                                         : light.high - light.low;
    const float steps = std::max(depth, 0.0f) * extent_steps(extent);
    sum += static_cast<uint64_t>(std::nearbyint(std::min(steps, max_extents * 65536)));
  }
  return is_tree(sum, end - begin, settings.threshold);
}

void ReferenceTrees::append(const Node& node) {
  nodes_.push_back({node.low, node.high, node.leaf ? node.first : node.lights,
                    (node.leaf ? ML_TREE_LEAF | node.lights << ML_TREE_COUNT_SHIFT : 0u) |
                        node.skip << ML_TREE_SKIP_SHIFT});
}

void ReferenceTrees::build_tree(const ReferenceLists& lists, uint32_t cell, uint32_t per_leaf, bool trim) {
  const uint32_t begin = lists.offsets()[cell], count = lists.offsets()[cell + 1] - begin;
  uint32_t used = (count + per_leaf - 1) / per_leaf, leaves = 1, height = 0;
  while (leaves < used) leaves *= 2, ++height;
  const uint32_t nodes = 2 * leaves - 1;
  tree_.resize(nodes);
  for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
    Node node{infinity, -infinity, 0, 0, 1, true};
    for (uint32_t i = leaf * per_leaf; i < std::min((leaf + 1) * per_leaf, count); ++i) {
      const DepthInterval light = lists.depth_of_rank()[lists.entries()[begin + i]];
      node.low = std::min(node.low, light.low);
      node.high = std::max(node.high, light.high);
      if (node.lights++ == 0) node.first = begin + i;
    }
    tree_[leaves - 1 + leaf] = node;
  }
  for (uint32_t i = leaves - 1; i-- > 0;) {
    const Node &left = tree_[2 * i + 1], &right = tree_[2 * i + 2];
    tree_[i] = {std::min(left.low, right.low), std::max(left.high, right.high), 0,
                left.lights + right.lights,    1 + left.skip + right.skip,      false};
  }
  while (tables_.size() <= height) {
    std::vector<uint32_t> table;
    list_depth_first(0, (2u << tables_.size()) - 1, table);
    tables_.push_back(std::move(table));
  }
  const size_t first = nodes_.size();
  for (uint32_t index : tables_[height]) append(tree_[index]);
  if (trim)
    while (nodes_.size() > first && nodes_.back().low > nodes_.back().high) nodes_.pop_back();
}

void ReferenceTrees::build(const ReferenceLists& lists, const TreeSettings& settings) {
  cell_depth_extents(lists.grid(), cell_depths_);
  const uint32_t cells = lists.grid().cells();
  cells_.assign(cells, {0, 0});
  nodes_.clear();
  for (uint32_t cell = 0; cell < cells; ++cell) {
    const uint32_t begin = lists.offsets()[cell], count = lists.offsets()[cell + 1] - begin;
    const uint32_t per_leaf = leaf_size(settings.lights_per_leaf, count);
    const auto first_node = static_cast<uint32_t>(nodes_.size());
    if (count > per_leaf && count > settings.list_lights && wants_tree(lists, cell, settings)) {
      build_tree(lists, cell, per_leaf, settings.trim_padding);
    } else if (!settings.list_nodes) {
      if (count > 0) cells_[cell] = {begin, ML_TREE_CELL_LIST | count};
      continue;
    } else {
      // Where one leaf cannot count a list's lights, each part is as many of its leaves as one can.
      const uint32_t max_part = ML_TREE_MAX_LEAF_LIGHTS / per_leaf * per_leaf;
      for (uint32_t part = 0; part < count; part += max_part) {
        Node node{infinity, -infinity, begin + part, std::min(count - part, max_part), 1, true};
        for (uint32_t i = 0; i < node.lights; ++i) {
          const DepthInterval light = lists.depth_of_rank()[lists.entries()[begin + part + i]];
          node.low = std::min(node.low, light.low);
          node.high = std::max(node.high, light.high);
        }
        append(node);
      }
    }
    if (count > 0) cells_[cell] = {first_node, static_cast<uint32_t>(nodes_.size())};
  }
  lights_.resize(lists.entries().size());
  for (size_t i = 0; i < lights_.size(); ++i) lights_[i] = lists.light_of_rank()[lists.entries()[i]];
}

}  // namespace ml
