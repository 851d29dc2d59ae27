// The slice function and the froxel grid.
#include "algorithms/froxels/froxel_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/base/random.h"

namespace ml {
namespace {

gpu_data::ViewData view_of(uint32_t width, uint32_t height, float far) {
  gpu_data::ViewData view{};
  view.resolution = {width, height};
  view.left_edge = -1, view.right_edge = 1, view.bottom_edge = -1, view.top_edge = 1;
  view.near = 0.1f;
  view.far = far;
  return view;
}

TEST(SliceFunction, Log2IsWithinItsStatedError) {
  Random random(1);
  for (int i = 0; i < 1'000'000; ++i) {
    float z = std::exp2(random.uniform(-60, 60));
    double truth = std::log2(static_cast<double>(z));
    // 1e-6 absolute, and the rounding of results that are themselves large.
    ASSERT_NEAR(static_cast<double>(gpu_data::slice_log2(z)), truth, 1e-6 + 1.2e-7 * std::abs(truth)) << z;
  }
}

TEST(SliceFunction, PapersGridHasTheNearSliceAndFifteenExponentialOnes) {
  gpu_data::SliceMapping mapping = FroxelGrid::make(view_of(1920, 1080, 500), 48, 16, 5, 0).mapping;
  EXPECT_EQ(gpu_data::slice_of_depth(4.9f, mapping), 0u);
  EXPECT_EQ(gpu_data::slice_of_depth(5.0f, mapping), 1u);
  EXPECT_EQ(gpu_data::slice_of_depth(50.0f, mapping), 8u);
  EXPECT_EQ(gpu_data::slice_of_depth(500.0f, mapping), 15u);
}

TEST(SliceFunction, IsTotalAndClamped) {
  gpu_data::SliceMapping mapping = FroxelGrid::make(view_of(100, 100, 500), 48, 16, 5, 0).mapping;
  const float infinity = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  for (float z : {0.0f, -0.0f, -1.0f, -infinity, nan, 1e-38f, 1e-45f})
    EXPECT_EQ(gpu_data::slice_of_depth(z, mapping), 0u) << z;
  for (float z : {501.0f, 1e9f, 3e38f, infinity}) EXPECT_EQ(gpu_data::slice_of_depth(z, mapping), 15u) << z;
}

TEST(SliceFunction, NeverStepsBackByMoreThanTheWideningOfBounds) {
  for (uint32_t slices : {1u, 2u, 16u, 256u}) {
    gpu_data::SliceMapping mapping = FroxelGrid::make(view_of(100, 100, 1e7f), 48, slices, 0.01f, 0).mapping;
    for (float z = 1e-3f; z < 2e7f; z *= 1.00013f)
      ASSERT_LE(gpu_data::slice_of_depth(z, mapping), gpu_data::slice_of_depth(z * 1.00001f, mapping))
          << z << ", " << slices;
  }
}

TEST(SliceFunction, RangesHoldTheirDepths) {
  FroxelGrid grid = FroxelGrid::make(view_of(100, 100, 700), 48, 24, 3, 0);
  std::vector<FroxelGrid::DepthRange> ranges;
  grid.slice_ranges(ranges);
  for (float z = 0.01f; z < 2000; z *= 1.0003f) {
    auto range = ranges[gpu_data::slice_of_depth(z, grid.mapping)];
    ASSERT_LE(range.low, z);
    ASSERT_GE(range.high, z);
  }
}

TEST(FroxelGrid, HasPartialLastColumnsAndRows) {
  FroxelGrid grid = FroxelGrid::make(view_of(1920, 1080, 500), 48, 16, 5, 0);
  EXPECT_EQ(grid.columns, 40u);
  EXPECT_EQ(grid.rows, 23u);
  EXPECT_EQ(grid.cells(), 14720u);
  EXPECT_EQ(FroxelGrid::make(view_of(1, 1, 500), 48, 1, 5, 0).cells(), 1u);
  EXPECT_EQ(FroxelGrid::make(view_of(97, 61, 500), 4, 2, 5, 0).columns, 25u);
}

// Shaders find a pixel's tile without a division.
TEST(FroxelGrid, TileOfAPixelIsThatOfTheDivision) {
  for (uint32_t tile = 1; tile <= 1024; ++tile) {
    const float inverse = FroxelGrid::make(view_of(16384, 16384, 500), tile, 1, 5, 0).data().inverse_tile;
    for (uint32_t pixel = 0; pixel < 16384; ++pixel)
      ASSERT_EQ(gpu_data::tile_of_pixel(pixel, inverse), pixel / tile) << pixel << " by " << tile;
  }
}

TEST(FroxelGrid, ZmaxBelowZminIsRaised) {
  FroxelGrid grid = FroxelGrid::make(view_of(100, 100, 3), 48, 16, 5, 0);
  EXPECT_TRUE(std::isfinite(grid.mapping.scale));
  EXPECT_EQ(gpu_data::slice_of_depth(1, grid.mapping), 0u);
  EXPECT_EQ(gpu_data::slice_of_depth(100, grid.mapping), 15u);
}

}  // namespace
}  // namespace ml
