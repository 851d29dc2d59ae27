#include "algorithms/froxels/froxel_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ml {

FroxelGrid FroxelGrid::make(const gpu_data::ViewData& view, uint32_t tile, uint32_t slices, float zmin,
                            float zmax) {
  FroxelGrid grid;
  grid.tile = tile;
  grid.columns = (view.resolution.x + tile - 1) / tile;
  grid.rows = (view.resolution.y + tile - 1) / tile;
  grid.slices = slices;
  const float far = std::max(zmax > 0 ? zmax : view.far, zmin * 1.001f);
  grid.near = view.near;
  grid.far = far;
  float log_min = gpu_data::slice_log2(zmin);
  grid.mapping = {log_min, static_cast<float>(slices - 1) / (gpu_data::slice_log2(far) - log_min), slices};
  return grid;
}

void FroxelGrid::slice_ranges(std::vector<DepthRange>& ranges) const {
  ranges.resize(slices);
  auto boundary = [&](uint32_t slice) {
    return std::exp2(static_cast<double>(mapping.log_min) +
                     (slice - 1.0) / static_cast<double>(mapping.scale));
  };
  for (uint32_t slice = 0; slice < slices; ++slice) {
    ranges[slice].low = slice == 0 ? 0 : static_cast<float>(boundary(slice) * (1 - 1e-5));
    ranges[slice].high = slice + 1 == slices ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(boundary(slice + 1) * (1 + 1e-5));
  }
}

BoundsConstants::BoundsConstants(const gpu_data::ViewData& v, const FroxelGrid& g) : view(v), grid(g) {
  left_edge = view.left_edge;
  top_edge = view.top_edge;
  x_pixels_per_unit = static_cast<float>(view.resolution.x) / (view.right_edge - view.left_edge);
  y_pixels_per_unit = static_cast<float>(view.resolution.y) / (view.bottom_edge - view.top_edge);
  inverse_tile = 1.0f / static_cast<float>(grid.tile);
  last_column_pixel = static_cast<float>(view.resolution.x - 1);
  last_row_pixel = static_cast<float>(view.resolution.y - 1);
}

}  // namespace ml
