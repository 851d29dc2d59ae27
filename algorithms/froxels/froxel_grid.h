// The froxel grid of practical clustered shading: screen tiles times depth slices.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/froxels/grid_data.h"
#include "shaders/shared/view.h"

namespace ml {

// One slice's froxels are neighbours in memory: lights that come in the order of depth touch few slices at a
// time, whose counters and lists then stay in the nearest caches.
struct FroxelGrid {
  uint32_t tile = 0;               // px
  uint32_t columns = 0, rows = 0;  // the last ones may be partial
  uint32_t slices = 0;
  float near = 0, far = 0;  // m, the view's near plane and where the last slice ends
  gpu_data::SliceMapping mapping{};

  uint32_t cells() const { return columns * rows * slices; }
  uint32_t tiles() const { return columns * rows; }  // froxels of a slice
  // The number of a froxel.
  uint32_t cell(uint32_t column, uint32_t row, uint32_t slice) const {
    return (slice * rows + row) * columns + column;
  }

  // The froxel of a surface point, as froxel_cell.glsl finds it.
  uint32_t cell_of(glm::uvec2 pixel, float depth) const {
    const float inverse_tile = data().inverse_tile;
    return cell(gpu_data::tile_of_pixel(pixel.x, inverse_tile),
                gpu_data::tile_of_pixel(pixel.y, inverse_tile), gpu_data::slice_of_depth(depth, mapping));
  }

  gpu_data::FroxelGridData data() const {
    return {mapping, 1.0f / static_cast<float>(tile), columns, tiles(), 0};
  }

  // `tile`, `slices` >= 1; `zmin` > 0; `zmax` 0 takes the view's far. A zmax at or below zmin is raised to
  // just above it.
  static FroxelGrid make(const gpu_data::ViewData& view, uint32_t tile, uint32_t slices, float zmin,
                         float zmax);

  // Depths between which a slice's surface points lie, widened by the error of the slice function: [low,
  // high) with low 0 for the first slice and high infinite for the last.
  struct DepthRange {
    float low, high;
  };
  void slice_ranges(std::vector<DepthRange>& ranges) const;
};

// A box of froxels: columns x0..x1, rows y0..y1, slices z0..z1, all inclusive. Empty when x0 > x1.
struct FroxelBox {
  uint16_t x0 = 1, x1 = 0, y0 = 0, y1 = 0, z0 = 0, z1 = 0;
  bool empty() const { return x0 > x1; }
  uint32_t count() const {
    return empty() ? 0 : uint32_t{x1 - x0 + 1u} * uint32_t{y1 - y0 + 1u} * uint32_t{z1 - z0 + 1u};
  }
  bool operator==(const FroxelBox&) const = default;
};

// Numbers that turn view-space balls into froxel boxes; the same for the scalar reference and the vector
// code.
struct BoundsConstants {
  explicit BoundsConstants(const gpu_data::ViewData& view, const FroxelGrid& grid);
  gpu_data::ViewData view;
  FroxelGrid grid;
  // Pixel of a window coordinate s (slope or metres): (s - edge) * pixels_per_unit.
  float left_edge, x_pixels_per_unit;
  float top_edge, y_pixels_per_unit;  // negative: rows grow downwards
  float inverse_tile;
  float last_column_pixel, last_row_pixel;  // width - 1, height - 1
};

// How much a ball is widened before it is bounded: relative for the rounding of distances, absolute for that
// of camera-relative coordinates (1e-6 of their sum, several times the rounding of three products).
inline constexpr float widen_relative = 1.00001f;
inline constexpr float widen_absolute = 2e-6f;
// Pixels by which a bound is widened on both sides, for the rounding of the projection itself.
inline constexpr float widen_pixels = 1.0f / 256;

}  // namespace ml
