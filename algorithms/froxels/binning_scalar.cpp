// The scalar reference of the binning stages.
#include <algorithm>
#include <cmath>

#include "algorithms/froxels/binning.h"

namespace ml {
namespace {

struct Interval {
  float low, high;
};

// Slopes between which the ball's circle in the plane of one axis and depth is seen, of the part at or beyond
// the near plane.
Interval perspective_interval(float a, float z, float radius, float near) {
  float distance2 = a * a + z * z;
  float tangent2 = distance2 - radius * radius;
  float tangent = std::sqrt(tangent2 > 0 ? tangent2 : 0);
  float behind = z - near;
  float chord2 = radius * radius - behind * behind;
  float chord = std::sqrt(chord2 > 0 ? chord2 : 0);
  // Tangent points, times distance: where such a point is nearer than the near plane (or there is none, the
  // camera being inside), the circle's widest visible point is where it crosses the near plane.
  float high_a = a * tangent + z * radius, high_z = z * tangent - a * radius;
  float low_a = a * tangent - z * radius, low_z = z * tangent + a * radius;
  bool high_seen = tangent2 > 0 && high_z * tangent >= near * distance2;
  bool low_seen = tangent2 > 0 && low_z * tangent >= near * distance2;
  return {low_seen ? low_a / low_z : (a - chord) / near, high_seen ? high_a / high_z : (a + chord) / near};
}

}  // namespace

void VisibleLights::reserve(size_t lights) {
  for (std::vector<float>* column : {&x, &y, &z, &radius}) reserve_padded(*column, lights);
  reserve_padded(index, lights);
}

void reserve_pairs(FroxelPairs& pairs, size_t count, bool with_reaches) {
  reserve_padded(pairs.cell, count);
  reserve_padded(pairs.light, count);
  if (!with_reaches) return;
  reserve_padded(pairs.minus_low, count);
  reserve_padded(pairs.high, count);
}

uint64_t count_pairs(const LightBox* boxes, const uint32_t* indices, size_t count) {
  uint64_t sum = 0;
  for (size_t i = 0; i < count; ++i) sum += boxes[indices ? indices[i] : i].froxels();
  return sum;
}

void BoxOffsets::build(const FroxelGrid& grid) {
  if (built_columns_ == grid.columns && built_rows_ == grid.rows) return;
  built_columns_ = grid.columns;
  built_rows_ = grid.rows;
  table_.assign(size_t{max_extent} * max_extent * max_extent * stride, 0);
  for (uint32_t columns = 1; columns <= max_extent; ++columns)
    for (uint32_t rows = 1; rows <= max_extent; ++rows)
      for (uint32_t slices = 1; slices <= max_extent; ++slices) {
        auto* next = const_cast<uint32_t*>(get(columns, rows, slices));
        for (uint32_t slice = 0; slice < slices; ++slice)
          for (uint32_t row = 0; row < rows; ++row)
            for (uint32_t column = 0; column < columns; ++column) *next++ = grid.cell(column, row, slice);
      }
}

namespace scalar {

DepthInterval depth_interval(float z, float radius) {
  // What is in front of the camera plane only matters where it is positive, so that the factor always widens.
  return {(z - radius) * 0.99999f, (z + radius) * 1.00001f};
}

FroxelBox bound_ball(const BoundsConstants& c, float x, float y, float z, float radius) {
  const gpu_data::ViewData& view = c.view;
  bool orthographic = view.orthographic != 0;
  Interval across =
      orthographic ? Interval{x - radius, x + radius} : perspective_interval(x, z, radius, view.near);
  Interval up =
      orthographic ? Interval{y - radius, y + radius} : perspective_interval(y, z, radius, view.near);
  // First and last pixel whose centre is inside; rows grow downwards.
  float column0 = std::ceil((across.low - c.left_edge) * c.x_pixels_per_unit - (0.5f + widen_pixels));
  float column1 = std::floor((across.high - c.left_edge) * c.x_pixels_per_unit - (0.5f - widen_pixels));
  float row0 = std::ceil((up.high - c.top_edge) * c.y_pixels_per_unit - (0.5f + widen_pixels));
  float row1 = std::floor((up.low - c.top_edge) * c.y_pixels_per_unit - (0.5f - widen_pixels));
  column0 = std::max(column0, 0.0f);
  row0 = std::max(row0, 0.0f);
  column1 = std::min(column1, c.last_column_pixel);
  row1 = std::min(row1, c.last_row_pixel);
  if (!(column0 <= column1 && row0 <= row1)) return {};
  auto tile = [&](float pixel) { return static_cast<uint16_t>((pixel + 0.5f) * c.inverse_tile); };
  auto slice = [&](float depth) {
    return static_cast<uint16_t>(gpu_data::slice_of_depth(depth, c.grid.mapping));
  };
  return {tile(column0),
          tile(column1),
          tile(row0),
          tile(row1),
          slice(depth_interval(z, radius).low),
          slice(depth_interval(z, radius).high)};
}

size_t cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& c,
            VisibleLights& visible) {
  size_t n = begin;
  const gpu_data::ViewData& v = c.view;
  bool orthographic = v.orthographic != 0;
  // A side plane at window coordinate e: inside where p - e * z >= 0 (perspective) or p - e >= 0
  // (orthographic), p along the axis; its normal has length sqrt(1 + e^2) or 1.
  auto outside = [&](float p, float z, float radius, float edge, float sign) {
    float length = orthographic ? 1.0f : std::sqrt(1.0f + edge * edge);
    float distance = orthographic ? p - edge : p - edge * z;
    return sign * distance < -radius * length;
  };
  for (size_t i = begin; i < end; ++i) {
    float wx = lights.x[i], wy = lights.y[i], wz = lights.z[i];
    float x = wx * v.right.x + wy * v.right.y + wz * v.right.z;
    float y = wx * v.up.x + wy * v.up.y + wz * v.up.z;
    float z = wx * v.forward.x + wy * v.forward.y + wz * v.forward.z;
    float radius =
        lights.radius[i] * widen_relative + widen_absolute * (std::abs(wx) + std::abs(wy) + std::abs(wz));
    if (z + radius < v.near) continue;
    if (orthographic && z - radius > v.far) continue;
    if (outside(x, z, radius, v.left_edge, 1) || outside(x, z, radius, v.right_edge, -1)) continue;
    if (outside(y, z, radius, v.bottom_edge, 1) || outside(y, z, radius, v.top_edge, -1)) continue;
    visible.x[n] = x;
    visible.y[n] = y;
    visible.z[n] = z;
    visible.radius[n] = radius;
    visible.index[n++] = static_cast<uint32_t>(i);
  }
  return n - begin;
}

uint64_t bound(const VisibleRun& visible, const BoundsConstants& c, LightBox* boxes) {
  uint64_t froxels = 0;
  for (size_t i = 0; i < visible.count; ++i) {
    FroxelBox box = bound_ball(c, visible.x[i], visible.y[i], visible.z[i], visible.radius[i]);
    if (box.empty()) {
      boxes[i] = {0, visible.index[i], 0, 0, 0};
      continue;
    }
    boxes[i] = {c.grid.cell(box.x0, box.y0, box.z0), visible.index[i],
                static_cast<uint16_t>(box.x1 - box.x0 + 1), static_cast<uint16_t>(box.y1 - box.y0 + 1),
                box.z1 - box.z0 + 1u};
    froxels += boxes[i].froxels();
  }
  return froxels;
}

}  // namespace scalar
}  // namespace ml
