#include "algorithms/trees/tree_prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "harness/base/error.h"

namespace ml {
namespace {

using gpu_data::TreeNode;

enum Slot : uint32_t { grid_slot, cells_slot, nodes_slot, indices_slot };

TreeNode* map_nodes(UploadMemory& memory, uint64_t nodes) {
  return reinterpret_cast<TreeNode*>(memory.map(nodes_slot, nodes * sizeof(TreeNode)).data());
}

// Where a single thread can build the nodes so that none has to be copied, or null. How many they will be is
// not known yet, so the capacity is for the largest number possible.
TreeNode* nodes_in_place(UploadMemory& memory, const FroxelLists& lists, const TreeSettings& trees,
                         const Threads& threads) {
  if (threads.count() > 1) return nullptr;
  map_nodes(memory, 0);
  const uint64_t capacity = CellTrees::capacity(lists, trees);
  if (!memory.cached(nodes_slot) || capacity * sizeof(TreeNode) > memory.limit()) return nullptr;
  return map_nodes(memory, capacity);
}

}  // namespace

TreePrepare::TreePrepare(const std::string& owner, const FroxelSettings& froxels, const TreeSettings& trees)
    : owner_(owner), froxels_(froxels), trees_(trees), lists_(owner) {
  froxels_.order = FroxelSettings::Order::depth;
}

void TreePrepare::prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) {
  lists_.build(frame, froxels_, memory, indices_slot, spans);
  {
    auto span = spans.span("build");
    cell_trees_.build(lists_, trees_, *frame.threads, nodes_in_place(memory, lists_, trees_, *frame.threads));
    classify_tiles();
  }
  const uint64_t node_bytes = cell_trees_.nodes() * sizeof(TreeNode);
  if (node_bytes > memory.limit())
    throw SystemError(
        fmt::format("{}: the trees would take {} bytes, the device's buffer holds {}; use fewer lights, "
                    "larger tiles or more "
                    "lights per leaf",
                    owner_, node_bytes, memory.limit()));

  auto span = spans.span("upload");
  const gpu_data::FroxelGridData header = lists_.grid_data();
  std::memcpy(memory.map(grid_slot, sizeof header).data(), &header, sizeof header);
  const auto cells = cell_trees_.cells();
  std::memcpy(memory.map(cells_slot, cells.size_bytes()).data(), cells.data(), cells.size_bytes());
  cell_trees_.copy_nodes(map_nodes(memory, cell_trees_.nodes()), *frame.threads);
  lists_.upload_entries(memory, indices_slot);

  counters_.in_frustum = lists_.lights_in_frustum();
  counters_.list_bytes = cells.size_bytes() + node_bytes + lists_.entry_bytes();
  counters_.list_cells = cell_trees_.list_cells();
  counters_.tree_cells = cell_trees_.tree_cells();
}

void TreePrepare::classify_tiles() {
  class_of_tile_.assign(lists_.grid().tiles(), 0);
  cell_trees_.mark_node_tiles(class_of_tile_);
}

TileClasses TreePrepare::tile_classes() const {
  return {1, lists_.grid().tile, lists_.grid().columns, class_of_tile_};
}

LongestWalk TreePrepare::longest_walk(bool masked) const {
  // A tree's nodes are fewer than twice its leaves, and padding may double those.
  const uint64_t lights = lists_.longest(), leaves = lights / trees_.lights_per_leaf + 1;
  LongestWalk walk{lights, std::min<uint64_t>(4 * leaves, 2 * ML_TREE_MAX_LEAVES)};
  // A subtree of 64 leaves is 127 nodes, and one node above; the last may be smaller. The leaves of a list
  // that one cannot count stand side by side, each a tree of its own.
  constexpr uint64_t list_leaf = ML_TREE_MAX_LEAF_LIGHTS - 63;
  if (masked) walk.subtrees = std::max(walk.nodes / 128, lights / list_leaf) + 1;
  return walk;
}

std::vector<ParameterInfo> tree_parameters() {
  return {
      ParameterInfo::integer("lights_per_leaf", 8, 1, 64,
                             "lights in a leaf; raised where a tree would have more than 2048 leaves"),
      ParameterInfo::choice("lists", "cell", {"cell", "node"},
                            "its cell says where a list is, or a tree of one node does (section 3.4)"),
      ParameterInfo::boolean("trim_padding", true, "leave out the nodes after a tree's last light"),
      ParameterInfo::choice("node_depths", "chord", {"chord", "ball"},
                            "with ball_test nodes hold the depths at which balls are met in the cell's "
                            "tile; or those of whole lights, as in the paper"),
  };
}

bool with_chords(const Parameters& parameters) {
  return parameters.choice("node_depths") == "chord";
}

TreeSettings tree_settings(const Parameters& parameters) {
  TreeSettings settings;
  settings.lights_per_leaf = static_cast<uint32_t>(parameters.integer("lights_per_leaf"));
  settings.list_nodes = parameters.choice("lists") == "node";
  settings.trim_padding = parameters.boolean("trim_padding");
  return settings;
}

}  // namespace ml
