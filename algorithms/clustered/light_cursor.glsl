// The list of the pixel's froxel.
layout(constant_id = 32) const bool DUPLICATED = false;
#include "algorithms/froxels/froxel_cell.glsl"

layout(scalar, binding = 17) readonly buffer Offsets { uint froxel_offsets[]; };
layout(scalar, binding = 18) readonly buffer Indices { uint froxel_indices[]; };
layout(scalar, binding = 19) readonly buffer Duplicates { LightCore froxel_lights[]; };
QUADS(DuplicatesQuads, 19);

struct LightCursor {
  uint next, end;
};

uint light_cell(SurfacePoint point) { return froxel_of_point(point); }

LightCursor cell_begin(uint froxel, float depth, bool counted) {
  LightCursor cursor = LightCursor(froxel_offsets[froxel], froxel_offsets[froxel + 1u]);
  if (counted) COUNT_LISTED(cursor.end - cursor.next);
  return cursor;
}

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

uint run_light(uint place) { return DUPLICATED ? place : index_of(froxel_indices[index_word(place)], place); }

// `light` is the light's index, or with duplicated data the place in the list itself.
bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= cursor.end) return false;
  light = run_light(cursor.next);
  cursor.next++;
  return true;
}

// The whole list is one run.
uint light_first_runs(inout LightCursor cursor, bool here) { return cursor.next < cursor.end ? 1u : 0u; }

uint light_next_runs(inout LightCursor cursor, bool here) { return 0u; }

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  first = cursor.next;
  count = cursor.end - cursor.next;
  return here;
}

#define CURSOR_RUNS

LightCore cursor_light(uint light) {
  if (!DUPLICATED) return light_at(light);
  if (TEXEL_FETCH) return light_of_quads(DuplicatesQuads, light);
  return froxel_lights[light];
}
#define CURSOR_LIGHT(light) cursor_light(light)
#define CURSOR_MORE(cursor) ((cursor).next < (cursor).end)
