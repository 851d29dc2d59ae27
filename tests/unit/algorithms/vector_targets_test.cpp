// Vector code gives the bits of scalar code with every instruction set that the processor has.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "algorithms/froxels/ball_test.h"
#include "algorithms/froxels/reference_lists.h"
#include "algorithms/heap_memory.h"
#include "algorithms/trees/reference_trees.h"
#include "algorithms/vector_target.h"
#include "binning_cases.h"
#include "harness/base/error.h"

namespace ml {
namespace {

using namespace test;

constexpr uint64_t no_limit = uint64_t{1} << 28;

// Calls body() with each instruction set in turn.
template <typename Body>
void with_every_target(Body body) {
  for (const std::string& name : simd::target_names()) {
    SCOPED_TRACE(name);
    simd::use_target(name);
    body();
    simd::use_target("");
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Numbers of lights around those that fill whole vectors, and any others.
uint32_t random_count(Random& random, uint32_t seed) {
  constexpr uint32_t lanes[] = {1, 4, 8, 16, 32, 64};
  if (seed % 3 == 0) return lanes[random.below(6)] * (1 + random.below(5)) - 1 + random.below(3);
  return seed % 50 == 1 ? 0 : random.below(500);
}

struct RandomFrame {
  Random random;
  Camera camera;
  BinningFrame fixture;
  explicit RandomFrame(uint32_t seed)
      : random(seed),
        camera(random_camera(random)),
        fixture(seed % 2 ? random_small_lights(random, random_count(random, seed), camera)
                         : random_lights(random, random_count(random, seed), camera),
                camera, 1 + random.below(400), 1 + random.below(400)) {}
  const FrameInput& frame() const { return fixture.frame; }
  BoundsConstants constants() {
    const FroxelSettings s = random_settings(random);
    return BoundsConstants(frame().view, FroxelGrid::make(frame().view, s.tile, s.slices, s.zmin, s.zmax));
  }
};

std::vector<uint32_t> bits_of(const std::vector<float>& values, size_t count) {
  std::vector<uint32_t> bits;
  for (size_t i = 0; i < count; ++i) bits.push_back(std::bit_cast<uint32_t>(values[i]));
  return bits;
}

void expect_same(const VisibleLights& a, const VisibleLights& b) {
  ASSERT_EQ(a.count, b.count);
  for (auto column : {&VisibleLights::x, &VisibleLights::y, &VisibleLights::z, &VisibleLights::radius})
    ASSERT_EQ(bits_of(a.*column, a.count), bits_of(b.*column, b.count));
  ASSERT_TRUE(
      std::equal(a.index.begin(), a.index.begin() + static_cast<ptrdiff_t>(a.count), b.index.begin()));
}

VisibleLights culled(const FrameInput& frame, const BoundsConstants& constants) {
  VisibleLights visible;
  visible.reserve(frame.lights.count());
  visible.count = scalar::cull(frame.lights, 0, frame.lights.count(), constants, visible);
  return visible;
}

// A frame with its lights culled and bounded by scalar code.
struct BoundedFrame : RandomFrame {
  const BoundsConstants bounds;
  const VisibleLights visible;
  std::vector<LightBox> boxes;
  uint64_t froxels = 0;           // of all boxes
  std::vector<uint32_t> indices;  // backwards, as those of another order
  BoxOffsets offsets;
  explicit BoundedFrame(uint32_t seed)
      : RandomFrame(seed), bounds(constants()), visible(culled(frame(), bounds)) {
    reserve_padded(boxes, visible.count);
    froxels = scalar::bound(visible, bounds, boxes.data());
    reserve_padded(indices, visible.count);
    for (size_t i = 0; i < visible.count; ++i) indices[i] = static_cast<uint32_t>(visible.count - 1 - i);
    offsets.build(bounds.grid);
  }
};

TEST(VectorTargets, AreNamedAndChosenByName) {
  const std::vector<std::string> names = simd::target_names();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(simd::target_name(), names.front());
  for (const std::string& name : names) {
    simd::use_target(name);
    EXPECT_EQ(simd::target_name(), name);
  }
  simd::use_target("");
  EXPECT_EQ(simd::target_names(), names);
  try {
    simd::use_target("AVX9");
    FAIL() << "an unknown instruction set was taken";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(names.back()), std::string::npos) << error.what();
  }
  EXPECT_EQ(simd::target_name(), names.front());
}

TEST(VectorTargets, CullGivesTheScalarBits) {
  with_every_target([] {
    for (uint32_t seed = 0; seed < 150; ++seed) {
      SCOPED_TRACE(seed);
      RandomFrame given(seed);
      const BoundsConstants constants = given.constants();
      const size_t lights = given.frame().lights.count();
      const VisibleLights expected = culled(given.frame(), constants);
      VisibleLights visible;
      visible.reserve(lights);
      std::vector<DepthReach> reaches;
      reserve_padded(reaches, lights);
      visible.count = simd::cull(given.frame().lights, 0, lights, constants, visible, reaches.data());
      expect_same(visible, expected);
      if (testing::Test::HasFatalFailure()) return;
      for (size_t i = 0; i < visible.count; ++i) {
        const DepthInterval depth = scalar::depth_interval(visible.z[i], visible.radius[i]);
        const DepthReach reach = reaches[visible.index[i]];
        ASSERT_EQ(std::bit_cast<uint32_t>(-reach.minus_low), std::bit_cast<uint32_t>(depth.low));
        ASSERT_EQ(std::bit_cast<uint32_t>(reach.high), std::bit_cast<uint32_t>(depth.high));
      }
    }
  });
}

TEST(VectorTargets, BoundsGiveTheScalarBits) {
  with_every_target([] {
    for (uint32_t seed = 0; seed < 150; ++seed) {
      SCOPED_TRACE(seed);
      RandomFrame given(1000 + seed);
      const BoundsConstants constants = given.constants();
      const VisibleLights visible = culled(given.frame(), constants);
      std::vector<LightBox> boxes, expected;
      reserve_padded(boxes, visible.count);
      reserve_padded(expected, visible.count);
      const uint64_t sum = simd::bound(visible, constants, boxes.data());
      ASSERT_EQ(sum, scalar::bound(visible, constants, expected.data()));
      for (size_t i = 0; i < visible.count; ++i) {
        const auto words = [](const LightBox& box) { return std::bit_cast<std::array<uint32_t, 4>>(box); };
        ASSERT_EQ(words(boxes[i]), words(expected[i])) << "light " << visible.index[i];
      }
    }
  });
}

TEST(VectorTargets, PairsAreThoseOfTheBoxes) {
  with_every_target([] {
    for (uint32_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(seed);
      const BoundedFrame given(2000 + seed);
      const FroxelGrid& grid = given.bounds.grid;
      FroxelPairs pairs;
      reserve_pairs(pairs, given.froxels);
      for (bool ordered : {false, true}) {
        const uint32_t* order = ordered ? given.indices.data() : nullptr;
        simd::emit(given.boxes.data(), order, given.visible.count, grid, given.offsets, pairs);
        ASSERT_EQ(pairs.count, given.froxels);
        size_t next = 0;
        for (size_t i = 0; i < given.visible.count; ++i) {
          const LightBox& box = given.boxes[order ? order[i] : i];
          for (uint32_t slice = 0; slice < box.slices; ++slice)
            for (uint32_t row = 0; row < box.rows; ++row)
              for (uint32_t column = 0; column < box.columns; ++column, ++next) {
                ASSERT_EQ(pairs.cell[next], box.first + grid.cell(column, row, slice));
                ASSERT_EQ(pairs.light[next], box.light);
              }
        }
      }
    }
  });
}

TEST(VectorTargets, BallTestGivesTheScalarPairs) {
  uint64_t left_out = 0;
  with_every_target([&] {
    for (uint32_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(seed);
      const BoundedFrame given(5000 + seed);
      const VisibleLights& visible = given.visible;
      const LightBox* boxes = given.boxes.data();
      BallTest test;
      test.build(given.bounds);
      FroxelPairs pairs, expected;
      reserve_pairs(pairs, given.froxels, true);
      reserve_pairs(expected, given.froxels, true);
      std::vector<DepthReach> reaches(given.frame().lights.count());
      for (size_t i = 0; i < visible.count; ++i) {
        const DepthInterval depths = scalar::depth_interval(visible.z[i], visible.radius[i]);
        reaches[visible.index[i]] = {-depths.low, depths.high};
      }
      for (bool ordered : {false, true}) {
        const uint32_t* order = ordered ? given.indices.data() : nullptr;
        const DepthReach* depths = ordered ? reaches.data() : nullptr;
        simd::emit_tested(visible, boxes, order, 0, visible.count, given.bounds, test, given.offsets, depths,
                          pairs);
        scalar::emit_tested(visible, boxes, order, 0, visible.count, given.bounds, test, depths, expected);
        const auto used = [&](const auto& all) { return std::span(all).first(pairs.count); };
        ASSERT_EQ(pairs.count, expected.count);
        ASSERT_TRUE(std::ranges::equal(used(pairs.cell), used(expected.cell)));
        ASSERT_TRUE(std::ranges::equal(used(pairs.light), used(expected.light)));
        if (depths) {
          ASSERT_TRUE(std::ranges::equal(used(pairs.minus_low), used(expected.minus_low)));
          ASSERT_TRUE(std::ranges::equal(used(pairs.high), used(expected.high)));
        }
        left_out += given.froxels - pairs.count;
      }
    }
  });
  EXPECT_GT(left_out, 0u);
}

// Whether it would be taken or not, and with lanes of 8, 16 and 32 bits.
TEST(VectorTargets, RowListsAreThoseOfTheBoxes) {
  with_every_target([] {
    for (uint32_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(seed);
      const BoundedFrame given(4000 + seed);
      const FroxelGrid& grid = given.bounds.grid;
      const VisibleLights& visible = given.visible;
      const std::vector<LightBox>& boxes = given.boxes;
      const uint64_t sum = given.froxels;
      std::vector<std::vector<uint32_t>> expected(grid.cells());
      for (size_t i = 0; i < visible.count; ++i)
        for (uint32_t slice = 0; slice < boxes[i].slices; ++slice)
          for (uint32_t row = 0; row < boxes[i].rows; ++row)
            for (uint32_t column = 0; column < boxes[i].columns; ++column)
              expected[boxes[i].first + grid.cell(column, row, slice)].push_back(boxes[i].light);
      for (size_t light_end : {given.frame().lights.count(), size_t{0x10000}, size_t{0x10001}}) {
        RowMemory memory;
        std::vector<uint32_t> offsets, list;
        reserve_padded(offsets, grid.cells() + size_t{1});
        reserve_padded(list, sum);
        const uint32_t longest = simd::list_rows(boxes.data(), nullptr, visible.count, grid, light_end,
                                                 memory, offsets.data(), list.data());
        ASSERT_EQ(offsets[grid.cells()], sum);
        size_t max_length = 0;
        for (uint32_t cell = 0; cell < grid.cells(); ++cell) {
          const auto found = std::span(list).subspan(offsets[cell], offsets[cell + 1] - offsets[cell]);
          ASSERT_TRUE(std::ranges::equal(found, expected[cell])) << "cell " << cell;
          max_length = std::max(max_length, found.size());
        }
        ASSERT_EQ(longest, max_length);
      }
    }
  });
}

// The order by index and by depth, trees and lists of nodes.
TEST(VectorTargets, ListsAndTreesAreThoseOfTheReference) {
  with_every_target([] {
    for (uint32_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(seed);
      RandomFrame given(3000 + seed);
      FroxelSettings froxels = random_settings(given.random);
      froxels.refinement = froxels.ball_test = false;
      Spans spans;
      FroxelLists lists{"test"};
      ReferenceLists reference;
      lists.build(given.frame(), froxels, no_limit, spans);
      reference.build(given.frame(), froxels);
      ASSERT_TRUE(std::ranges::equal(lists.offsets(), reference.offsets()));
      ASSERT_TRUE(std::ranges::equal(lists.entries(), reference.entries()));

      froxels.order = FroxelSettings::Order::depth;
      TreeSettings trees;
      trees.lights_per_leaf = 1 + given.random.below(20);
      trees.threshold = given.random.below(2) ? 1 : 0.4f;
      trees.clipped = given.random.below(2) != 0;
      trees.list_nodes = given.random.below(2) != 0;
      lists.build(given.frame(), froxels, no_limit, spans);
      reference.build(given.frame(), froxels);
      CellTrees cell_trees;
      cell_trees.build(lists, trees, *given.frame().threads);
      std::vector<gpu_data::TreeNode> nodes(cell_trees.nodes());
      cell_trees.copy_nodes(nodes.data(), *given.frame().threads);
      ReferenceTrees expected;
      expected.build(reference, trees);
      ASSERT_TRUE(std::ranges::equal(lists.entries(), expected.lights()));
      const auto node_words = [](const auto& node) { return std::bit_cast<std::array<uint32_t, 4>>(node); };
      const auto cell_words = [](const auto& cell) { return std::bit_cast<std::array<uint32_t, 2>>(cell); };
      ASSERT_TRUE(std::ranges::equal(nodes, expected.nodes(), {}, node_words, node_words));
      ASSERT_TRUE(std::ranges::equal(cell_trees.cells(), expected.cells(), {}, cell_words, cell_words));
    }
  });
}

}  // namespace
}  // namespace ml
