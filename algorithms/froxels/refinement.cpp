#include "algorithms/froxels/refinement.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

// Distance of a value from an interval, 0 inside.
float distance_to(float value, float low, float high) {
  return std::max({low - value, value - high, 0.0f});
}

}  // namespace

void RefinementPlanes::build(const BoundsConstants& c) {
  c.grid.slice_ranges(slices);
  row_low.clear();
  row_high.clear();
  for (uint32_t row = 0; row < c.grid.rows; ++row) {
    auto first = static_cast<float>(row * c.grid.tile);
    float last = std::min(static_cast<float>((row + 1) * c.grid.tile), c.last_row_pixel + 1);
    // Rows grow downwards: the row's first pixel is its upper edge. A pixel of slack covers all rounding.
    row_high.push_back(c.top_edge + (first - 0.5f) / c.y_pixels_per_unit);
    row_low.push_back(c.top_edge + (last + 0.5f) / c.y_pixels_per_unit);
  }
}

void emit_refined(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                  size_t count, const BoundsConstants& c, const RefinementPlanes& planes,
                  FroxelPairs& pairs) {
  const FroxelGrid& grid = c.grid;
  const bool orthographic = c.view.orthographic != 0;
  size_t n = 0;
  for (size_t k = 0; k < count; ++k) {
    const size_t i = indices ? indices[k] : first + k;
    const LightBox& box = boxes[i];
    if (box.columns == 0) continue;
    const float x = visible.x[i], y = visible.y[i], z = visible.z[i], radius = visible.radius[i];
    const uint32_t column0 = box.first % grid.columns, row0 = box.first / grid.columns % grid.rows;
    const uint32_t z0 = box.first / grid.columns / grid.rows;
    const uint32_t column1 = column0 + box.columns - 1;
    for (uint32_t row = row0; row < row0 + box.rows; ++row) {
      // Distance from the centre to the wedge (or slab) of the row.
      const float low = planes.row_low[row], high = planes.row_high[row];
      float above = orthographic ? y - high : (y - high * z) / std::sqrt(1 + high * high);
      float below = orthographic ? low - y : (low * z - y) / std::sqrt(1 + low * low);
      float row_distance = std::max({above, below, 0.0f});
      float row_left = radius * radius - row_distance * row_distance;
      if (!(row_left >= 0)) continue;
      for (uint32_t slice = z0; slice < z0 + box.slices; ++slice) {
        const FroxelGrid::DepthRange range = planes.slices[slice];
        float slice_distance = distance_to(z, range.low, range.high);
        float left = std::min(row_left, radius * radius - slice_distance * slice_distance);
        if (!(left >= 0)) continue;
        // Half width of the ball between the planes, and the depths at which it is.
        float half = std::sqrt(left) * widen_relative;
        float near = std::max({range.low, z - radius, c.view.near}), far = std::min(range.high, z + radius);
        float right_edge = x + half, left_edge = x - half;
        if (!orthographic) {
          // Seen widest at the near depth when away from the axis, at the far depth when towards it.
          right_edge /= right_edge > 0 ? near : std::max(far, near);
          left_edge /= left_edge < 0 ? near : std::max(far, near);
        }
        float pixel0 = std::max(std::ceil((left_edge - c.left_edge) * c.x_pixels_per_unit - 1.0f), 0.0f);
        float pixel1 =
            std::min(std::floor((right_edge - c.left_edge) * c.x_pixels_per_unit), c.last_column_pixel);
        if (!(pixel0 <= pixel1)) continue;
        uint32_t from = std::max(column0, static_cast<uint32_t>((pixel0 + 0.5f) * c.inverse_tile));
        uint32_t to = std::min(column1, static_cast<uint32_t>((pixel1 + 0.5f) * c.inverse_tile));
        for (uint32_t column = from; column <= to; ++column) {
          pairs.cell[n] = grid.cell(column, row, slice);
          pairs.light[n++] = box.light;
        }
      }
    }
  }
  pairs.count = n;
}

}  // namespace ml
