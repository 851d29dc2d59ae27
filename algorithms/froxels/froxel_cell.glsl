// Where a surface point lies in the froxel grid, and light indices of its lists.
#ifndef ML_FROXEL_CELL_GLSL
#define ML_FROXEL_CELL_GLSL
#include "algorithms/froxels/grid_data.h"

layout(scalar, binding = 16) readonly buffer Grid { FroxelGridData grid_data; };
FroxelGridData grid = grid_data;  // read before all branches, as the view is (shaders/surface.glsl)

// Where a list's light index stands among words, and what the word says. Indices of 16 bits are asked for by
// NARROW_INDICES; frames of more lights than those can tell apart have whole words.
layout(constant_id = 48) const bool NARROW_INDICES = false;
uint index_word(uint entry) { return NARROW_INDICES && grid.narrow != 0u ? entry >> 1 : entry; }
uint index_of(uint word, uint entry) {
  return NARROW_INDICES && grid.narrow != 0u ? word >> ((entry & 1u) << 4) & 0xffffu : word;
}

uint tile_of_point(SurfacePoint point) {
  return tile_of_pixel(point.pixel.y, grid.inverse_tile) * grid.columns +
         tile_of_pixel(point.pixel.x, grid.inverse_tile);
}

uint froxel_of_point(SurfacePoint point) {
  return slice_of_depth(point.depth, grid.mapping) * grid.tiles + tile_of_point(point);
}

#endif
