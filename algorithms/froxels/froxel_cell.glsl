// Where a surface point lies in the froxel grid.
#ifndef ML_FROXEL_CELL_GLSL
#define ML_FROXEL_CELL_GLSL
#include "algorithms/froxels/grid_data.h"

layout(scalar, binding = 16) readonly buffer Grid { FroxelGridData grid_data; };
FroxelGridData grid = grid_data;  // read before all branches, as the view is (shaders/surface.glsl)

uint tile_of_point(SurfacePoint point) {
  return tile_of_pixel(point.pixel.y, grid.inverse_tile) * grid.columns + tile_of_pixel(point.pixel.x, grid.inverse_tile);
}

uint froxel_of_point(SurfacePoint point) { return slice_of_depth(point.depth, grid.mapping) * grid.tiles + tile_of_point(point); }

#endif
