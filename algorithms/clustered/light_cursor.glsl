// The list of the pixel's froxel.
#include "shaders/shared/slices.h"

layout(constant_id = 16) const bool DUPLICATED = false;
layout(scalar, binding = 16) readonly buffer Grid {
  SliceMapping slice_mapping;
  uint tile_size, tile_columns, tile_count;
};
layout(scalar, binding = 17) readonly buffer Offsets { uint froxel_offsets[]; };
layout(scalar, binding = 18) readonly buffer Indices { uint froxel_indices[]; };
layout(scalar, binding = 19) readonly buffer Duplicates { LightCore froxel_lights[]; };

struct LightCursor {
  uint next, end;
};

uint light_cell(SurfacePoint point) {
  uvec2 tile = point.pixel / tile_size;
  return slice_of_depth(point.depth, slice_mapping) * tile_count + tile.y * tile_columns + tile.x;
}

LightCursor cell_begin(uint froxel, float depth, bool counted) {
  LightCursor cursor = LightCursor(froxel_offsets[froxel], froxel_offsets[froxel + 1u]);
  if (counted) COUNT_LISTED(cursor.end - cursor.next);
  return cursor;
}

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

// `light` is an index into lights[], or with duplicated data the place in the list itself.
bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= cursor.end) return false;
  light = DUPLICATED ? cursor.next : froxel_indices[cursor.next];
  cursor.next++;
  return true;
}

// The whole list is one run.
uint light_next_runs(inout LightCursor cursor, bool here, out bool more) {
  more = false;
  return cursor.next < cursor.end ? 1u : 0u;
}

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  first = cursor.next;
  count = cursor.end - cursor.next;
  return here;
}

uint run_light(uint place) { return DUPLICATED ? place : froxel_indices[place]; }
#define CURSOR_RUNS

LightCore cursor_light(uint light) {
  if (DUPLICATED) return froxel_lights[light];
  return lights[light];
}
#define CURSOR_LIGHT(light) cursor_light(light)
#define CURSOR_MORE(cursor) ((cursor).next < (cursor).end)
