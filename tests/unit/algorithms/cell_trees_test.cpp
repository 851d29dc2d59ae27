// Light trees: every light is reached wherever it may shine, the same as the scalar reference, within the
// node's fields, independent of threads.
#include "algorithms/trees/cell_trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "algorithms/heap_memory.h"
#include "algorithms/trees/reference_trees.h"
#include "algorithms/trees/tree_prepare.h"
#include "binning_cases.h"

namespace ml {
namespace {

using namespace test;
using gpu_data::TreeNode;

constexpr uint64_t no_limit = uint64_t{1} << 28;
constexpr float infinity = std::numeric_limits<float>::infinity();

TreeSettings random_trees(Random& random) {
  TreeSettings settings;
  settings.lights_per_leaf = 1 + random.below(64);
  constexpr float thresholds[] = {0, 0.25f, 0.5f, 1, infinity};
  settings.threshold = thresholds[random.below(5)];
  settings.trim_padding = random.below(2) != 0;
  settings.list_nodes = random.below(2) != 0;
  settings.list_lights = random.below(2) * random.below(100);
  settings.clipped = random.below(2) != 0;
  return settings;
}

struct Trees {
  FroxelLists lists{"test"};
  CellTrees cell_trees;
  std::vector<TreeNode> nodes;
  Trees(const FrameInput& frame, FroxelSettings froxels, const TreeSettings& settings) {
    froxels.order = FroxelSettings::Order::depth;
    Spans spans;
    lists.build(frame, froxels, no_limit, spans);
    cell_trees.build(lists, settings, *frame.threads);
    nodes.resize(cell_trees.nodes());
    cell_trees.copy_nodes(nodes.data(), *frame.threads);
  }
  // Listing 3: the lights that a pixel of this cell and depth gets to see, in order.
  std::vector<uint32_t> walk(uint32_t cell, float depth) const {
    std::vector<uint32_t> lights;
    const gpu_data::TreeCell stored = cell_trees.cells()[cell];
    if (stored.end & ML_TREE_CELL_LIST) {
      const auto list = lists.entries().subspan(stored.first, stored.end & ~ML_TREE_CELL_LIST);
      return {list.begin(), list.end()};
    }
    for (uint32_t i = stored.first; i < stored.end;) {
      const TreeNode& node = nodes[i];
      const bool hit = node.low <= depth && depth <= node.high;
      if (hit && tree_is_leaf(node))
        for (uint32_t k = 0; k < tree_leaf_lights(node); ++k)
          lights.push_back(lists.entries()[node.first_or_below + k]);
      i += hit ? 1 : tree_skip(node);
    }
    return lights;
  }
};

TEST(CellTrees, EveryLightIsReachedWhereverAPixelCanSeeInsideIt) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const uint32_t width = 1 + random.below(200), height = 1 + random.below(200);
    Camera camera = random_camera(random);
    BinningFrame fixture(random_lights(random, 80, camera), camera, width, height);
    FroxelSettings settings = random_settings(random);
    Trees trees(fixture.frame, settings, random_trees(random));
    SCOPED_TRACE(seed);
    expect_no_light_lost(random, fixture.frame, trees.lists.grid(), 200,
                         [&](uint32_t cell, float depth) { return trees.walk(cell, depth); });
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(CellTrees, FastPathGivesTheReferencesBits) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(1000 + seed);
    Camera camera = random_camera(random);
    const auto make = seed % 2 ? random_small_lights : random_lights;
    BinningFrame fixture(make(random, random.below(1500), camera), camera, 1 + random.below(400),
                         1 + random.below(400));
    FroxelSettings froxels = random_settings(random);
    froxels.refinement = froxels.ball_test = false;
    froxels.order = FroxelSettings::Order::depth;
    const TreeSettings settings = random_trees(random);
    Trees trees(fixture.frame, froxels, settings);
    ReferenceLists lists;
    ReferenceTrees reference;
    lists.build(fixture.frame, froxels);
    reference.build(lists, settings);
    ASSERT_TRUE(std::ranges::equal(trees.lists.entries(), reference.lights())) << "seed " << seed;
    ASSERT_TRUE(
        std::ranges::equal(trees.cell_trees.cells(), reference.cells(),
                           [](const auto& a, const auto& b) { return a.first == b.first && a.end == b.end; }))
        << "seed " << seed;
    ASSERT_EQ(trees.nodes.size(), reference.nodes().size()) << "seed " << seed;
    for (size_t i = 0; i < trees.nodes.size(); ++i) {
      const TreeNode &fast = trees.nodes[i], &plain = reference.nodes()[i];
      ASSERT_TRUE(fast.low == plain.low && fast.high == plain.high &&
                  fast.first_or_below == plain.first_or_below && fast.packed == plain.packed)
          << "seed " << seed << ", node " << i;
    }
  }
}

// Builds once more, in place, and expects the same nodes and nothing written past their capacity.
void expect_same_in_place(const Trees& trees, const TreeSettings& settings, Threads& threads) {
  const TreeNode untouched{1, 2, 3, 4};
  const size_t capacity = CellTrees::capacity(trees.lists, settings);
  std::vector<TreeNode> nodes(capacity + 100, untouched);
  CellTrees in_place;
  in_place.build(trees.lists, settings, threads, nodes.data());
  ASSERT_LE(in_place.nodes(), capacity);
  in_place.copy_nodes(nodes.data(), threads);
  const auto bytes = [](const TreeNode& node) { return std::bit_cast<std::array<std::byte, 16>>(node); };
  const auto end = nodes.begin() + static_cast<ptrdiff_t>(in_place.nodes());
  EXPECT_TRUE(std::ranges::equal(std::span(nodes.begin(), end), trees.nodes, {}, bytes, bytes));
  for (size_t i = capacity; i < nodes.size(); ++i)
    ASSERT_EQ(bytes(nodes[i]), bytes(untouched)) << "node " << i;
}

TEST(CellTrees, BuiltInPlaceTheyAreTheSameAndKeepToTheirCapacity) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(5000 + seed);
    Camera camera = random_camera(random);
    BinningFrame fixture(random_lights(random, random.below(800), camera), camera, 1 + random.below(300),
                         1 + random.below(300));
    const TreeSettings settings = random_trees(random);
    const Trees trees(fixture.frame, random_settings(random), settings);
    expect_same_in_place(trees, settings, *fixture.frame.threads);
  }
}

TEST(CellTrees, DepthFirstIndicesAreThoseOfAWalk) {
  for (uint32_t height = 0; height <= 12; ++height) {
    std::vector<std::pair<uint32_t, uint32_t>> order;  // (level, index)
    auto visit = [&](auto& self, uint32_t level, uint32_t index) -> void {
      order.emplace_back(level, index);
      if (level < height) self(self, level + 1, 2 * index), self(self, level + 1, 2 * index + 1);
    };
    visit(visit, 0, 0);
    for (uint32_t i = 0; i < order.size(); ++i)
      ASSERT_EQ(depth_first_index(height, order[i].first, order[i].second), i);
  }
}

Camera square_camera() {
  Camera camera;
  camera.projection = Projection::perspective(1, 1, 0.1f, 100);
  return camera;
}

// All of them in one tile.
std::vector<Light> lights_in_a_row(uint32_t count) {
  std::vector<Light> lights(count);
  for (uint32_t i = 0; i < count; ++i)
    lights[i].position = {0.1, 0.1, -3 - 20.0 * i / count}, lights[i].radius = 0.4f;
  return lights;
}

FroxelSettings one_tile() {
  FroxelSettings froxels;
  froxels.tile = 64;
  froxels.slices = 1;
  return froxels;
}

// Trees of a light more than a power of two of full leaves take the most memory for their lights; with more
// than 2048 leaves these get larger.
TEST(CellTrees, TheLargestTreesForTheirLightsKeepToTheirCapacity) {
  for (uint32_t per_leaf : {1u, 3u, 8u, 64u})
    for (uint32_t full_leaves : {1u, 2u, 4u, 32u, 512u, 2048u, 4096u}) {
      const uint32_t count = per_leaf * full_leaves + 1;
      SCOPED_TRACE(count);
      BinningFrame fixture(lights_in_a_row(count), square_camera(), 64, 64);
      TreeSettings settings;
      settings.threshold = infinity;
      settings.lights_per_leaf = per_leaf;
      settings.trim_padding = false;
      const Trees trees(fixture.frame, one_tile(), settings);
      ASSERT_EQ(trees.lists.entries().size(), count);
      if (full_leaves < ML_TREE_MAX_LEAVES) {
        ASSERT_EQ(trees.nodes.size(), 4 * full_leaves - 1);
      }
      expect_same_in_place(trees, settings, *fixture.frame.threads);
    }
}

TEST(CellTrees, OneTileHoldsAsManyLightsAsAFrameHas) {
  for (uint32_t count : {1u, 8u, 9u, 65535u, 65536u, 65537u, 262144u}) {
    BinningFrame fixture(lights_in_a_row(count), square_camera(), 64, 64);
    for (float threshold : {0.0f, 1.0f, infinity})
      for (uint32_t per_leaf : {1u, 8u, 64u})
        for (bool list_nodes : {false, true}) {
          TreeSettings settings;
          settings.threshold = threshold;
          settings.lights_per_leaf = per_leaf;
          settings.list_nodes = list_nodes;
          Trees trees(fixture.frame, one_tile(), settings);
          uint64_t below = 0;
          for (const TreeNode& node : trees.nodes)
            if (tree_is_leaf(node)) below += tree_leaf_lights(node);
          for (const gpu_data::TreeCell& cell : trees.cell_trees.cells())
            if (cell.end & ML_TREE_CELL_LIST) below += cell.end & ~ML_TREE_CELL_LIST;
          EXPECT_EQ(below, count);
          // Any one light is found at its own depth, and from a tree few others.
          const uint32_t light = count / 2;
          const float depth = static_cast<float>(3 + 20.0 * light / count);
          std::vector<uint32_t> reached = trees.walk(0, depth);
          EXPECT_TRUE(std::ranges::find(reached, light) != reached.end()) << count << " " << threshold;
          if (threshold == infinity && count > 1000) {
            EXPECT_LT(reached.size(), count / 10);
          }
        }
  }
}

TEST(CellTrees, LightsBeyondTheFarDepthAreSortedToo) {
  std::vector<Light> lights(4000);
  for (size_t i = 0; i < lights.size(); ++i) {
    // One after the other in an order that is none of depth; the far depth is 100 m.
    const double depth = 105 + 80.0 * static_cast<double>(i * 1237 % lights.size()) / 4000.0;
    lights[i].position = {0.1, 0.1, -depth}, lights[i].radius = 3;
  }
  BinningFrame fixture(lights, square_camera(), 64, 64);
  TreeSettings settings;
  settings.threshold = infinity;
  Trees trees(fixture.frame, one_tile(), settings);
  ASSERT_EQ(trees.lists.entries().size(), lights.size());
  for (float depth : {106.0f, 140.0f, 183.0f}) EXPECT_LT(trees.walk(0, depth).size(), 400u) << depth;
}

TEST(CellTrees, PaddingIsNeverHit) {
  Random random(3);
  Camera camera = random_camera(random);
  BinningFrame fixture(random_lights(random, 1000, camera), camera, 320, 180);
  TreeSettings settings;
  settings.lights_per_leaf = 3;
  settings.threshold = infinity;
  size_t full = 0, trimmed = 0;
  for (bool trim : {false, true}) {
    settings.trim_padding = trim;
    Trees trees(fixture.frame, {}, settings);
    for (const TreeNode& node : trees.nodes) {
      if (!tree_is_leaf(node) || tree_leaf_lights(node) > 0) continue;
      EXPECT_GT(node.low, node.high);
    }
    (trim ? trimmed : full) = trees.nodes.size();
  }
  EXPECT_LT(trimmed, full);
}

TEST(CellTrees, ThresholdChoosesListsAndTrees) {
  Random random(4);
  Camera camera = random_camera(random);
  BinningFrame fixture(random_lights(random, 3000, camera), camera, 320, 180);
  TreeSettings settings;
  uint64_t trees_before = 0, cells = 0;
  for (float threshold : {0.0f, 0.25f, 0.5f, 1.0f, infinity}) {
    settings.threshold = threshold;
    Trees trees(fixture.frame, {}, settings);
    if (threshold == 0) {
      EXPECT_EQ(trees.cell_trees.tree_cells(), 0u);
      cells = trees.cell_trees.list_cells();
    }
    EXPECT_GE(trees.cell_trees.tree_cells(), trees_before);
    EXPECT_EQ(trees.cell_trees.tree_cells() + trees.cell_trees.list_cells(), cells);
    trees_before = trees.cell_trees.tree_cells();
  }
  EXPECT_GT(trees_before, 0u);
}

// Shaders of the class without trees read no nodes.
TEST(CellTrees, TilesWithNodesAreAClassOfTheirOwn) {
  uint32_t with_nodes = 0, without = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    Random random(6000 + seed);
    Camera camera = random_camera(random);
    const std::vector<Light> lights = random_small_lights(random, random.below(600), camera);
    const FroxelSettings froxels = random_settings(random);
    const TreeSettings settings = random_trees(random);
    for (unsigned threads : {1u, 3u}) {
      BinningFrame fixture(lights, camera, 200, 120, threads);
      TreePrepare prepare("test", froxels, settings);
      HeapMemory memory;
      Spans spans;
      prepare.prepare(fixture.frame, memory, spans);
      const TileClasses classes = prepare.tile_classes();
      const uint32_t tiles = prepare.lists().grid().tiles();
      ASSERT_EQ(classes.of_tile.size(), tiles);
      for (uint32_t tile = 0; tile < tiles; ++tile) {
        bool nodes = false;
        for (uint32_t cell = tile; cell < prepare.lists().grid().cells(); cell += tiles) {
          const uint32_t end = prepare.cell_trees().cells()[cell].end;
          nodes = nodes || (end != 0 && (end & ML_TREE_CELL_LIST) == 0);
        }
        ASSERT_EQ(classes.of_tile[tile], nodes ? 1 : 0) << "seed " << seed << ", tile " << tile;
        (nodes ? with_nodes : without) += 1;
      }
    }
  }
  EXPECT_GT(with_nodes, 0u);
  EXPECT_GT(without, 0u);
}

TEST(CellTrees, DoNotDependOnTheNumberOfThreads) {
  for (uint32_t count : {0u, 1u, 2047u, 65537u}) {
    Random random(count);
    Camera camera = random_camera(random);
    std::vector<Light> lights = random_small_lights(random, count, camera);
    std::vector<std::vector<std::byte>> results;
    for (unsigned threads : {1u, 2u, 7u}) {
      BinningFrame fixture(lights, camera, 640, 360, threads);
      TreePrepare prepare("test", {}, {});
      HeapMemory memory;
      Spans spans;
      prepare.prepare(fixture.frame, memory, spans);
      prepare.prepare(fixture.frame, memory, spans);
      results.push_back(memory.all());
    }
    EXPECT_TRUE(results[0] == results[1] && results[0] == results[2]) << count;
  }
}

TEST(CellTrees, AFrameWithFewerLightsLeavesNothingBehind) {
  Random random(5);
  Camera camera = random_camera(random);
  std::vector<Light> many = random_lights(random, 5000, camera), few(many.begin(), many.begin() + 10);
  BinningFrame large(many, camera, 640, 360), small(few, camera, 64, 64);
  TreePrepare reused("test", {}, {}), fresh("test", {}, {});
  HeapMemory reused_memory, fresh_memory(false);
  Spans spans;
  reused.prepare(large.frame, reused_memory, spans);
  reused.prepare(small.frame, reused_memory, spans);
  fresh.prepare(small.frame, fresh_memory, spans);
  EXPECT_TRUE(reused_memory.all() == fresh_memory.all());
}

}  // namespace
}  // namespace ml
