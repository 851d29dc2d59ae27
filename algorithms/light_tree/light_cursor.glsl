// The tree of the pixel's tile.
layout(constant_id = 16) const bool HAS_TREES = true;
#include "algorithms/trees/tree_walk.glsl"

uint light_cell(SurfacePoint point) {
  uvec2 tile = point.pixel / tile_size;
  return tile.y * tile_columns + tile.x;
}

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

bool light_next(inout LightCursor cursor, out uint light, out float weight) { return tree_next(cursor, light, weight); }
