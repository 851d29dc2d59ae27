// The exact test of a light's ball against a froxel: a tile's pyramid between two depths. Inside its box of
// froxels a ball misses those at corners and edges; with one slice these are tiles, as in the code that the
// authors of Tiled Light Trees published.
//
// At depth q the nearest point of a froxel lies at x and y clamped to the tile there, so its squared distance
// g(q) from the ball's centre is a convex function of one variable: the smallest value over the froxel's
// depths is looked for by a step of Newton's. Whatever it finds, g(a) + g'(a) (q - a) + (q - a)^2 lies
// below g everywhere, and only where its smallest value exceeds the squared radius the froxel is left out: no
// light is lost by a step that went astray.
//
// The same bound tells between which depths the ball can be met in the tile at all: where it does not exceed
// the squared radius. Seen through a tile at its rim a ball is a short chord, so a tree's nodes become
// tighter than with the depths of whole balls.
#pragma once

#include "algorithms/froxels/binning.h"

namespace ml {

// Whether a box may hold froxels that its ball misses: along one axis alone the ball reaches every one.
inline bool has_corners(const LightBox& box) {
  return (box.columns > 1) + (box.rows > 1) + (box.slices > 1) > 1;
}

// What is constant over a frame; padded for vector code.
struct BallTest {
  // Window coordinates (slopes, or metres) between which the pixel centres of a column or row lie, and depths
  // (m) of a slice's surface points; widened.
  std::vector<float> column_low, column_high, row_low, row_high, slice_low, slice_high;
  std::vector<FroxelGrid::DepthRange> depth_ranges;  // what build() takes the slices' depths from
  // Coordinates of each froxel of a box: column + (row << 8) + (slice << 16), ordered as BoxOffsets is.
  std::vector<uint32_t> coordinates;
  const uint32_t* box_coordinates(uint32_t columns, uint32_t rows, uint32_t slices) const {
    constexpr uint32_t max_extent = BoxOffsets::max_extent;
    return &coordinates[(((columns - 1) * max_extent + rows - 1) * max_extent + slices - 1) *
                        BoxOffsets::stride];
  }
  void build(const BoundsConstants& constants);
};

// What is added to the square under the root of a chord, relative to what it is the difference of: many times
// what rounding takes. Depths are then widened like those of whole balls.
inline constexpr float chord_slack = 1e-6f;

// A ball, seen through the tile of a froxel.
struct BallInFroxel {
  bool reached;        // whether it may reach the froxel; true where it does
  DepthReach between;  // depths (m) of all its points in the tile, those of other slices too
};

namespace scalar {
BallInFroxel ball_in_froxel(const BallTest& test, bool orthographic, float x, float y, float z, float radius,
                            uint32_t column, uint32_t row, uint32_t slice);
// See below.
void emit_tested(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                 size_t count, const BoundsConstants& constants, const BallTest& test,
                 const DepthReach* reaches, FroxelPairs& pairs);
}  // namespace scalar

namespace simd {
// Writes the pairs of those froxels that the balls reach. The boxes and their lights are those at
// indices[0..count), with padding after them, or without indices at [first, first + count). With `reaches`,
// the depths of whole lights by index, each pair gets those at which the ball is met in its tile and the
// light is within them.
void emit_tested(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                 size_t count, const BoundsConstants& constants, const BallTest& test,
                 const BoxOffsets& offsets, const DepthReach* reaches, FroxelPairs& pairs);
}  // namespace simd

}  // namespace ml
