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

uint run_light(uint entry) { return DUPLICATED ? entry : index_of(froxel_indices[index_word(entry)], entry); }

// `light` is the light's index, or with duplicated data that of its entry in the list.
bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= cursor.end) return false;
  light = run_light(cursor.next);
  cursor.next++;
  return true;
}

#include "shaders/one_run.glsl"

LightCore cursor_light(uint light) {
  if (!DUPLICATED) return light_at(light);
  if (TEXEL_FETCH) return light_of_quads(DuplicatesQuads, light);
  return froxel_lights[light];
}
#define CURSOR_LIGHT(light) cursor_light(light)
