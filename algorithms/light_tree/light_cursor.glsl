// The tree of the pixel's tile.
#include "algorithms/trees/tree_walk.glsl"

uint light_cell(SurfacePoint point) { return tile_of_point(point); }

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

bool light_next(inout LightCursor cursor, out uint light, out float weight) { return tree_next(cursor, light, weight); }
