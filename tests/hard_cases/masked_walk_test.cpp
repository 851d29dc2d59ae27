// The masked walk of trees: what each pixel asks and tests is what algorithms/trees/README.md says, node by
// node and light by light, for trees of one leaf to many subtrees.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "algorithms/froxels/grid_data.h"
#include "algorithms/heap_memory.h"
#include "algorithms/trees/tree_chunk.h"
#include "shaders/shared/pixel_groups.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

using gpu_data::TreeCell;
using gpu_data::TreeNode;

constexpr uint32_t width = 61, height = 45;

// Slots of algorithms/trees/tree_prepare.cpp.
struct Upload {
  HeapMemory memory;
  gpu_data::FroxelGridData grid() const { return reinterpret_cast<const gpu_data::FroxelGridData&>(*at(0)); }
  const TreeCell* cells() const { return reinterpret_cast<const TreeCell*>(at(1)); }
  const TreeNode* nodes() const { return reinterpret_cast<const TreeNode*>(at(2)); }

 private:
  const std::byte* at(uint32_t slot) const { return memory.slot(slot).data(); }
};

struct Work {
  uint32_t nodes = 0, tested = 0;
};

bool holds(const TreeNode& node, float depth) {
  return node.low <= depth && depth <= node.high;
}

// A subtree of up to 64 leaves: adds what each pixel asks to its nodes; returns the lights of all leaves that
// some pixel hits.
uint32_t merge_subtree(const TreeNode* nodes, uint32_t root, uint32_t end, uint32_t levels,
                       const std::vector<float>& depths, std::vector<Work>& work) {
  const uint32_t below = std::min(levels, 3u), level = levels - below;
  std::set<uint32_t> leaves;
  for (size_t i = 0; i < depths.size(); ++i)
    for (uint32_t upper = 0; upper < 1u << level; ++upper) {
      const uint32_t upper_node = root + depth_first_index(levels, level, upper);
      if (upper_node >= end) continue;
      ++work[i].nodes;
      if (!holds(nodes[upper_node], depths[i])) continue;
      if (below == 0) leaves.insert(upper_node);
      for (uint32_t leaf = upper << below; below > 0 && leaf < (upper + 1) << below; ++leaf) {
        const uint32_t own = root + depth_first_index(levels, levels, leaf);
        if (own >= end) continue;
        ++work[i].nodes;
        if (holds(nodes[own], depths[i])) leaves.insert(own);
      }
    }
  uint32_t lights = 0;
  for (uint32_t leaf : leaves) {
    EXPECT_TRUE(tree_is_leaf(nodes[leaf]));
    lights += tree_leaf_lights(nodes[leaf]);
  }
  return lights;
}

// What the pixels of a subgroup that lie in one cell ask and test, by their depths.
std::vector<Work> walk_cell(const Upload& upload, uint32_t cell, const std::vector<float>& depths) {
  std::vector<Work> work(depths.size());
  const TreeCell stored = upload.cells()[cell];
  const bool list = (stored.end & ML_TREE_CELL_LIST) != 0;
  uint32_t lights = list ? stored.end & ~ML_TREE_CELL_LIST : 0;
  const TreeNode* nodes = upload.nodes();
  for (uint32_t node = stored.first; !list && node < stored.end;) {
    const uint32_t skip = tree_skip(nodes[node]), levels = std::countr_zero(skip + 1) - 1;
    bool hit = true;
    if (levels >= 6) {
      hit = false;
      for (size_t i = 0; i < depths.size(); ++i) {
        ++work[i].nodes;
        hit |= holds(nodes[node], depths[i]);
      }
    }
    if (hit && levels <= 6) lights += merge_subtree(nodes, node, stored.end, levels, depths, work);
    node += hit && levels > 6 ? 1 : skip;
  }
  for (Work& one : work) one.tested = lights;
  return work;
}

// Of every pixel.
std::vector<Work> walk_frame(const Upload& upload, const std::vector<float>& position_depth) {
  const uint32_t lanes = device().limits().subgroup_size;
  std::vector<Work> work(size_t{width} * height);
  const gpu_data::FroxelGridData grid = upload.grid();
  for (uint32_t y = 0; y < height; y += 8)
    for (uint32_t x = 0; x < width; x += 8)
      for (uint32_t first = 0; first < 64; first += lanes) {
        std::map<uint32_t, std::vector<size_t>> pixels_of_cell;
        for (uint32_t thread = first; thread < std::min(first + lanes, 64u); ++thread) {
          const glm::uvec2 pixel = glm::uvec2(x, y) + gpu_data::pixel_in_block(thread);
          if (pixel.x >= width || pixel.y >= height) continue;
          const size_t i = size_t{pixel.y} * width + pixel.x;
          const float depth = position_depth[4 * i + 3];
          if (!(depth > 0)) continue;
          const uint32_t tile = gpu_data::tile_of_pixel(pixel.y, grid.inverse_tile) * grid.columns +
                                gpu_data::tile_of_pixel(pixel.x, grid.inverse_tile);
          pixels_of_cell[gpu_data::slice_of_depth(depth, grid.mapping) * grid.tiles + tile].push_back(i);
        }
        for (const auto& [cell, pixels] : pixels_of_cell) {
          std::vector<float> depths;
          for (size_t i : pixels) depths.push_back(position_depth[4 * i + 3]);
          const std::vector<Work> own = walk_cell(upload, cell, depths);
          for (size_t i = 0; i < pixels.size(); ++i) work[pixels[i]] = own[i];
        }
      }
  return work;
}

class MaskedWalk : public DeviceTest, public testing::WithParamInterface<const char*> {};

TEST_P(MaskedWalk, PixelsAskAndTestWhatIsWrittenOfThem) {
  const AlgorithmEntry& entry = find_algorithm(GetParam(), "test");
  std::vector<Light> lights = mixed_shapes(40, {-25, 0, -30}, {25, 9, 18}, 1, 15, 5);
  const std::vector<Light> crowd = scattered(460, {-6, 0, -14}, {3, 4, 6}, 0.2f, 1.5f, 6, 4);
  lights.insert(lights.end(), crowd.begin(), crowd.end());
  FrameOptions options = all_shapes();
  options.tests.poison_shared = true;
  Exactness check(yard(), width, height, options);
  std::vector<Trial> trials;
  // 500 lights in trees of up to 512, 256, 64, 64, 16 leaves; with large tiles they are all in one. No more,
  // so that no driver needs the loop for long walks, in which subgroups of several cells do not walk
  // together.
  for (int64_t per_leaf : {1, 2, 8, 15, 60})
    for (int64_t tile : {16, 64})
      for (bool trim : {false, true}) {
        Trial trial{entry.info.name, Parameters(entry.parameters)};
        const auto set = [&](const char* name, const ParameterValue& value) {
          if (trial.parameters.values().contains(name))
            trial.parameters.set(entry.parameters, name, value, "test");
        };
        set("walk", std::string("masked"));
        set("lights_per_leaf", per_leaf);
        set("tile", tile);
        set("trim_padding", trim);
        set("slices", int64_t{3});
        set("list_lights", int64_t{trim ? 0 : 8});
        set("lists", std::string(trim ? "cell" : "node"));
        trials.push_back(trial);
      }
  const Seen seen =
      check.expect_trials(camera_at({-3, 3, 20}, {-2, 3.5, 0}, width, height), lights, trials, 0);
  const std::vector<float> position_depth = check.frame().read_aov(DeviceFrame::Aov::position);
  for (size_t t = 0; t < trials.size(); ++t) {
    SCOPED_TRACE(trials[t].text());
    Upload upload;
    Spans spans;
    const auto algorithm = entry.create(trials[t].parameters);
    algorithm->prepare(check.input(), upload.memory, spans);
    const std::vector<Work> work = walk_frame(upload, position_depth);
    uint64_t wrong = 0, shared = 0;
    for (size_t i = 0; i < work.size(); ++i) {
      wrong += work[i].nodes != seen.counts[t].nodes[i] || work[i].tested != seen.counts[t].tested[i];
      shared += seen.counts[t].tested[i] < seen.counts[t].listed[i];
    }
    EXPECT_EQ(wrong, 0u) << "pixels";
    EXPECT_GT(shared, 0u) << "no pixel leaves a leaf out";
  }
}

INSTANTIATE_TEST_SUITE_P(HardCases, MaskedWalk, testing::Values("light_tree", "hybrid"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace ml::test
