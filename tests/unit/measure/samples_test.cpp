#include "harness/measure/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace ml {
namespace {

TEST(SampleTable, KeepsEverySampleWhereItBelongs) {
  SampleTable table(3, 4);
  for (uint32_t repeat = 0; repeat < 3; ++repeat) {
    for (uint32_t frame = 0; frame < 4; ++frame) table.set("shade", repeat, frame, repeat * 10 + frame);
  }
  ASSERT_EQ(table.tables().count("shade"), 1u);
  const auto& laps = table.tables().find("shade")->second;
  ASSERT_EQ(laps.size(), 3u);
  std::vector<double> all;
  for (uint32_t repeat = 0; repeat < 3; ++repeat) {
    ASSERT_EQ(laps[repeat].size(), 4u);
    for (uint32_t frame = 0; frame < 4; ++frame) {
      EXPECT_EQ(laps[repeat][frame], repeat * 10 + frame);
      all.push_back(laps[repeat][frame]);
    }
  }
  EXPECT_EQ(table.all("shade"), all);
  EXPECT_TRUE(table.all("cull").empty());
}

TEST(SampleTable, NamesHaveTablesOfTheirOwn) {
  SampleTable table(1, 2);
  table.set("a", 0, 0, 1);
  table.set("b", 0, 1, 2);
  EXPECT_EQ(table.all("a"), (std::vector<double>{1, 0}));
  EXPECT_EQ(table.all("b"), (std::vector<double>{0, 2}));
}

TEST(SampleTable, FirstKeepsWholeLapsOnly) {
  SampleTable table(3, 2);
  for (uint32_t repeat = 0; repeat < 3; ++repeat) {
    for (uint32_t frame = 0; frame < 2; ++frame) table.set("x", repeat, frame, repeat + 1);
  }
  for (uint32_t kept = 0; kept <= 5; ++kept) {
    SampleTable part = table.first(kept);
    uint32_t expected = std::min(kept, 3u);
    EXPECT_EQ(part.repeats(), expected);
    std::vector<double> all = part.all("x");
    ASSERT_EQ(all.size(), expected * 2);
    for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<double>(i / 2 + 1));
  }
}

TEST(InterleavedOrder, IsAPermutationOfAllCases) {
  for (uint32_t cases : {0u, 1u, 2u, 7u, 64u, 1000u}) {
    for (uint32_t lap = 0; lap < 5; ++lap) {
      std::vector<uint32_t> order = interleaved_order(cases, 1, lap, 3);
      ASSERT_EQ(order.size(), cases);
      std::sort(order.begin(), order.end());
      for (uint32_t i = 0; i < cases; ++i) ASSERT_EQ(order[i], i);
    }
  }
}

TEST(InterleavedOrder, SameSeedSameOrder) {
  for (uint32_t lap = 0; lap < 20; ++lap)
    EXPECT_EQ(interleaved_order(9, 5, lap, 2), interleaved_order(9, 5, lap, 2));
}

TEST(InterleavedOrder, DependsOnSeedLapAndFrame) {
  std::set<std::vector<uint32_t>> orders;
  for (uint32_t seed = 0; seed < 4; ++seed) {
    for (uint32_t lap = 0; lap < 4; ++lap) {
      for (uint32_t frame = 0; frame < 4; ++frame) orders.insert(interleaved_order(30, seed, lap, frame));
    }
  }
  EXPECT_EQ(orders.size(), 64u);
}

// Chi-square over all 24 orders of four cases: 23 degrees of freedom, 99.9 % below 49.7.
TEST(InterleavedOrder, EveryPermutationIsEquallyLikely) {
  std::map<std::vector<uint32_t>, int> counts;
  constexpr int laps = 200, frames = 120;
  for (uint32_t lap = 0; lap < laps; ++lap) {
    for (uint32_t frame = 0; frame < frames; ++frame) ++counts[interleaved_order(4, 1, lap, frame)];
  }
  ASSERT_EQ(counts.size(), 24u);
  constexpr double expected = laps * frames / 24.0;
  double chi_square = 0;
  for (const auto& [order, count] : counts) chi_square += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi_square, 49.7);
}

// No case is measured first (or last) more often than chance allows, within one lap too.
TEST(InterleavedOrder, EveryCaseTakesEveryPosition) {
  constexpr uint32_t cases = 5, frames = 5000;
  std::array<std::array<int, cases>, cases> counts{};
  for (uint32_t frame = 0; frame < frames; ++frame) {
    std::vector<uint32_t> order = interleaved_order(cases, 7, 0, frame);
    for (uint32_t position = 0; position < cases; ++position) ++counts[position][order[position]];
  }
  for (const auto& position : counts) {
    for (int count : position)
      EXPECT_NEAR(count, frames / cases, 4.5 * 28.3);  // 28.3 = sqrt(5000 * 0.2 * 0.8)
  }
}

}  // namespace
}  // namespace ml
