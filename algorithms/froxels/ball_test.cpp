// What is constant over a frame, and the scalar reference.
#include "algorithms/froxels/ball_test.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

// Pixels beyond the outermost pixel centres: several times what rounding takes of window coordinates.
constexpr float slack_pixels = 1.0f / 64;

// Edges of cells along one axis of the window.
void window_edges(uint32_t cells, uint32_t tile, float last_pixel, float edge, float pixels_per_unit,
                  std::vector<float>& low, std::vector<float>& high) {
  reserve_padded(low, cells);
  reserve_padded(high, cells);
  for (uint32_t cell = 0; cell < cells; ++cell) {
    const float first = static_cast<float>(cell * tile) + 0.5f - slack_pixels;
    const float last = std::min(static_cast<float>(cell * tile + tile - 1), last_pixel) + 0.5f + slack_pixels;
    const float a = edge + first / pixels_per_unit, b = edge + last / pixels_per_unit;
    low[cell] = std::min(a, b);
    high[cell] = std::max(a, b);
  }
}

// The side of a tile that is nearest to a coordinate at a depth, while it lies outside; all 0 inside.
struct Side {
  float edge;  // the side is at edge * depth, in an orthographic view at edge
  float away;  // how far outside, signed
};
Side nearest_side(float at, float low, float high, float scale) {
  const float below = low * scale - at, above = high * scale - at;
  return below > 0 ? Side{low, below} : above < 0 ? Side{high, above} : Side{0, 0};
}

float clamped(float value, float low, float high) {
  return std::min(std::max(value, low), high);
}

}  // namespace

void BallTest::build(const BoundsConstants& c) {
  window_edges(c.grid.columns, c.grid.tile, c.last_column_pixel, c.left_edge, c.x_pixels_per_unit, column_low,
               column_high);
  window_edges(c.grid.rows, c.grid.tile, c.last_row_pixel, c.top_edge, c.y_pixels_per_unit, row_low,
               row_high);
  c.grid.slice_ranges(depth_ranges);
  reserve_padded(slice_low, depth_ranges.size());
  reserve_padded(slice_high, depth_ranges.size());
  for (size_t slice = 0; slice < depth_ranges.size(); ++slice) {
    slice_low[slice] = std::max(depth_ranges[slice].low, c.view.near * 0.99999f);
    slice_high[slice] = std::max(depth_ranges[slice].high, slice_low[slice]);
  }
  if (!coordinates.empty()) return;
  constexpr uint32_t max_extent = BoxOffsets::max_extent;
  coordinates.assign(size_t{max_extent} * max_extent * max_extent * BoxOffsets::stride, 0);
  for (uint32_t columns = 1; columns <= max_extent; ++columns)
    for (uint32_t rows = 1; rows <= max_extent; ++rows)
      for (uint32_t depth = 1; depth <= max_extent; ++depth) {
        auto* next = const_cast<uint32_t*>(box_coordinates(columns, rows, depth));
        for (uint32_t slice = 0; slice < depth; ++slice)
          for (uint32_t row = 0; row < rows; ++row)
            for (uint32_t column = 0; column < columns; ++column)
              *next++ = column + (row << 8) + (slice << 16);
      }
}

namespace scalar {

BallInFroxel ball_in_froxel(const BallTest& t, bool orthographic, float x, float y, float z, float radius,
                            uint32_t column, uint32_t row, uint32_t slice) {
  const float left = t.column_low[column], right = t.column_high[column];
  const float bottom = t.row_low[row], top = t.row_high[row];
  const float near = t.slice_low[slice], far = t.slice_high[slice];
  float depth = clamped(z, near, far);
  Side across{}, up{};
  if (orthographic) {
    across = nearest_side(x, left, right, 1);
    up = nearest_side(y, bottom, top, 1);
    across.edge = up.edge = 0;
  } else {
    across = nearest_side(x, left, right, depth);
    up = nearest_side(y, bottom, top, depth);
    const float squares = 1 + across.edge * across.edge + up.edge * up.edge;
    depth = clamped((z + across.edge * x + up.edge * y) / squares, near, far);
    across = nearest_side(x, left, right, depth);
    up = nearest_side(y, bottom, top, depth);
  }
  const float ahead = depth - z;
  const float distance2 = ahead * ahead + across.away * across.away + up.away * up.away;
  const float half_slope = ahead + across.edge * across.away + up.edge * up.away;
  const float step = clamped(0 - half_slope, near - depth, far - depth);
  const bool reached = !(distance2 + step * (half_slope + half_slope + step) > radius * radius);
  // Where distance2 + 2 half_slope s + s^2 is radius^2, s metres beyond `depth`.
  const float squares = half_slope * half_slope + radius * radius;
  const float half = std::sqrt(std::max(squares - distance2 + squares * chord_slack, 0.0f));
  const float middle = depth - half_slope;
  return {reached, {(half - middle) * 0.99999f, (half + middle) * 1.00001f}};
}

void emit_tested(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                 size_t count, const BoundsConstants& c, const BallTest& test, const DepthReach* reaches,
                 FroxelPairs& pairs) {
  const FroxelGrid& grid = c.grid;
  const bool orthographic = c.view.orthographic != 0;
  size_t n = 0;
  for (size_t k = 0; k < count; ++k) {
    const size_t i = indices ? indices[k] : first + k;
    const LightBox& box = boxes[i];
    const uint32_t column0 = box.first % grid.columns, row0 = box.first / grid.columns % grid.rows;
    const uint32_t slice0 = box.first / grid.columns / grid.rows;
    for (uint32_t slice = 0; slice < box.slices; ++slice)
      for (uint32_t row = 0; row < box.rows; ++row)
        for (uint32_t column = 0; column < box.columns; ++column) {
          DepthReach reach = reaches ? reaches[box.light] : DepthReach{};
          if (has_corners(box)) {
            const BallInFroxel ball =
                ball_in_froxel(test, orthographic, visible.x[i], visible.y[i], visible.z[i],
                               visible.radius[i], column0 + column, row0 + row, slice0 + slice);
            if (!ball.reached) continue;
            reach = {std::min(ball.between.minus_low, reach.minus_low),
                     std::min(ball.between.high, reach.high)};
          }
          if (reaches) {
            pairs.minus_low[n] = reach.minus_low;
            pairs.high[n] = reach.high;
          }
          pairs.cell[n] = box.first + grid.cell(column, row, slice);
          pairs.light[n++] = box.light;
        }
  }
  pairs.count = n;
}

}  // namespace scalar
}  // namespace ml
