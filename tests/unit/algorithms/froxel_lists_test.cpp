// Clustered binning: conservative, the same as the scalar reference, independent of threads.
#include "algorithms/froxels/froxel_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/heap_memory.h"
#include "binning_cases.h"
#include "harness/base/error.h"

namespace ml {
namespace {

using namespace test;

constexpr uint64_t no_limit = uint64_t{1} << 28;

std::vector<uint32_t> list_of(const FroxelLists& lists, uint32_t froxel) {
  auto indices =
      lists.entries().subspan(lists.offsets()[froxel], lists.offsets()[froxel + 1] - lists.offsets()[froxel]);
  return {indices.begin(), indices.end()};
}

TEST(FroxelLists, EveryLightIsListedWhereverAPixelCanSeeInsideIt) {
  for (uint32_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const uint32_t width = 1 + random.below(200), height = 1 + random.below(200);
    Camera camera = random_camera(random);
    BinningFrame fixture(random_lights(random, 60, camera), camera, width, height);
    FroxelSettings settings = random_settings(random);
    FroxelLists lists{"clustered"};
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    SCOPED_TRACE(seed);
    expect_no_light_lost(random, fixture.frame, lists.grid(), 300, [&](uint32_t cell, float) {
      std::vector<uint32_t> list = list_of(lists, cell);
      EXPECT_TRUE(std::ranges::is_sorted(list)) << "froxel " << cell;
      return list;
    });
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(FroxelLists, VectorCodeGivesTheReferencesBits) {
  uint32_t by_rows = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(1000 + seed);
    Camera camera = random_camera(random);
    const auto make = seed % 2 ? random_small_lights : random_lights;
    BinningFrame fixture(make(random, random.below(700), camera), camera, 1 + random.below(400),
                         1 + random.below(400));
    FroxelSettings settings = random_settings(random);
    settings.refinement = settings.ball_test = false;
    FroxelLists lists{"clustered"};
    ReferenceLists reference;
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    reference.build(fixture.frame, settings);
    ASSERT_TRUE(std::ranges::equal(lists.offsets(), reference.offsets())) << "seed " << seed;
    by_rows += lists.built_by_rows();
    ASSERT_TRUE(std::ranges::equal(lists.entries(), reference.entries())) << "seed " << seed;
  }
  // Both ways of writing lists were taken.
  EXPECT_GT(by_rows, 30u);
  EXPECT_LT(by_rows, 270u);
}

// Words, or with narrow indices half words, of which the last word may lack one.
std::vector<std::byte> as_uploaded(std::span<const uint32_t> entries, bool narrow) {
  if (!narrow) return {std::as_bytes(entries).begin(), std::as_bytes(entries).end()};
  std::vector<uint16_t> half(entries.begin(), entries.end());
  half.resize((half.size() + 1) / 2 * 2);
  const auto bytes = std::as_bytes(std::span(half));
  return {bytes.begin(), bytes.end()};
}

TEST(FroxelLists, AreTheSameWhereTheyAreBuiltInUploadMemory) {
  uint32_t by_rows = 0, narrow = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    Random random(5000 + seed);
    Camera camera = random_camera(random);
    const auto make = seed % 2 ? random_small_lights : random_lights;
    // One light more than 8, 16 bits can number, too.
    const uint32_t count = seed % 10 == 9 ? 65537 : seed % 10 == 8 ? 257 : random.below(600);
    BinningFrame fixture(make(random, count, camera), camera, 320, 180);
    const FroxelSettings settings = random_settings(random);
    FroxelLists own{"clustered"}, in_place{"clustered"}, staged{"clustered"};
    Spans spans;
    HeapMemory cached, uncached{false};
    own.build(fixture.frame, settings, no_limit, spans);
    in_place.build(fixture.frame, settings, cached, 0, spans);
    staged.build(fixture.frame, settings, uncached, 0, spans);
    in_place.upload_entries(cached, 0);
    staged.upload_entries(uncached, 0);
    const std::vector<std::byte> bytes = as_uploaded(own.entries(), own.grid_data().narrow != 0);
    ASSERT_EQ(own.grid_data().narrow != 0, settings.narrow && count <= 65536);
    ASSERT_TRUE(std::ranges::equal(cached.all(), bytes)) << "seed " << seed;
    ASSERT_TRUE(std::ranges::equal(uncached.all(), bytes)) << "seed " << seed;
    ASSERT_TRUE(std::ranges::equal(in_place.entries(), own.entries())) << "seed " << seed;
    by_rows += own.built_by_rows();
    narrow += own.grid_data().narrow;
  }
  EXPECT_GT(by_rows, 5u);
  EXPECT_LT(by_rows, 55u);
  EXPECT_GT(narrow, 10u);
}

TEST(FroxelLists, NarrowingOnlyTakesAway) {
  size_t plain = 0, refined = 0, tested = 0;
  for (uint32_t seed = 0; seed < 100; ++seed) {
    Random random(2000 + seed);
    Camera camera = random_camera(random);
    BinningFrame fixture(random_lights(random, 200, camera), camera, 320, 180);
    FroxelSettings settings = random_settings(random);
    settings.refinement = settings.ball_test = false;
    FroxelLists without{"clustered"};
    Spans spans;
    without.build(fixture.frame, settings, no_limit, spans);
    plain += without.entries().size();
    for (bool ball_test : {false, true}) {
      settings.refinement = !ball_test;
      settings.ball_test = ball_test;
      FroxelLists with{"clustered"};
      with.build(fixture.frame, settings, no_limit, spans);
      (ball_test ? tested : refined) += with.entries().size();
      for (uint32_t froxel = 0; froxel < with.grid().cells(); ++froxel) {
        std::vector<uint32_t> fewer = list_of(with, froxel), more = list_of(without, froxel);
        ASSERT_TRUE(std::ranges::includes(more, fewer)) << "seed " << seed << ", froxel " << froxel;
      }
    }
  }
  EXPECT_LT(refined, plain);
  EXPECT_LT(tested, refined);
}

TEST(FroxelLists, DoNotDependOnTheNumberOfThreads) {
  for (uint32_t count : {0u, 1u, 2047u, 4096u, 65535u, 65536u, 65537u}) {
    Random random(count);
    Camera camera = random_camera(random);
    std::vector<Light> lights = random_small_lights(random, count, camera);
    for (int narrowing : {0, 1, 2}) {
      FroxelSettings settings;
      settings.refinement = narrowing == 1;
      settings.ball_test = narrowing == 2;
      std::vector<std::vector<uint32_t>> results;
      for (unsigned threads : {1u, 2u, 7u}) {
        BinningFrame fixture(lights, camera, 640, 360, threads);
        FroxelLists lists{"clustered"};
        Spans spans;
        lists.build(fixture.frame, settings, no_limit, spans);
        results.emplace_back(lists.offsets().begin(), lists.offsets().end());
        results.back().insert(results.back().end(), lists.entries().begin(), lists.entries().end());
      }
      ASSERT_EQ(results[0], results[1]) << count;
      ASSERT_EQ(results[0], results[2]) << count;
    }
  }
}

TEST(FroxelLists, AFrameWithFewerLightsLeavesNothingBehind) {
  Random random(5);
  Camera camera = random_camera(random);
  std::vector<Light> many = random_lights(random, 5000, camera), few(many.begin(), many.begin() + 10);
  BinningFrame large(many, camera, 640, 360), small(few, camera, 64, 64);
  FroxelSettings settings;
  FroxelLists reused{"clustered"}, fresh{"clustered"};
  Spans spans;
  reused.build(large.frame, settings, no_limit, spans);
  reused.build(small.frame, settings, no_limit, spans);
  fresh.build(small.frame, settings, no_limit, spans);
  EXPECT_TRUE(std::ranges::equal(reused.offsets(), fresh.offsets()));
  EXPECT_TRUE(std::ranges::equal(reused.entries(), fresh.entries()));
}

TEST(FroxelLists, MoreEntriesThanTheLimitAreRefusedBeforeMemoryIsTaken) {
  Camera camera;
  camera.projection = Projection::perspective(1, 1, 0.1f, 100);
  std::vector<Light> lights(65536);
  for (Light& light : lights) light.radius = 1000;  // each covers the whole view
  BinningFrame fixture(lights, camera, 1920, 1080);
  FroxelLists lists{"clustered"};
  Spans spans;
  for (int narrowing : {0, 1, 2}) {
    FroxelSettings settings;
    settings.refinement = narrowing == 1;
    settings.ball_test = narrowing == 2;
    EXPECT_THROW(lists.build(fixture.frame, settings, 1 << 25, spans), SystemError);
  }
}

TEST(FroxelLists, AllLightsInOneFroxel) {
  Camera camera;
  camera.projection = Projection::perspective(1, 1, 0.1f, 100);
  for (uint32_t count : {255u, 256u, 257u, 65535u, 65536u, 65537u}) {
    std::vector<Light> lights(count);
    for (Light& light : lights) light.position = {0.3, 0.3, -3}, light.radius = 0.1f;
    BinningFrame fixture(lights, camera, 64, 64);
    FroxelSettings settings;
    settings.tile = 64;
    FroxelLists lists{"clustered"};
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    ASSERT_EQ(lists.entries().size(), count);
    EXPECT_EQ(lists.longest(), count);
    for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(lists.entries()[i], i);
  }
}

}  // namespace
}  // namespace ml
