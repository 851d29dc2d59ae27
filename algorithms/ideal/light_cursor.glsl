// The pixel's own list of contributing lights; where pixels walk together the list of all lights that contribute to
// some pixel of their group.
#include "shaders/shared/pixel_groups.h"

layout(constant_id = 32) const uint GROUP_PIXELS = 8u;
layout(scalar, binding = 16) readonly buffer ListOffsets { uint list_offsets[]; };
layout(scalar, binding = 17) readonly buffer ListIndices { uint list_indices[]; };
layout(scalar, binding = 18) readonly buffer GroupOffsets { uint group_offsets[]; };
layout(scalar, binding = 19) readonly buffer GroupIndices { uint group_indices[]; };

struct LightCursor {
  uint next, end;
};

LightCursor light_begin(SurfacePoint point) {
  uint pixel = point.pixel.y * view.resolution.x + point.pixel.x;
  LightCursor cursor = LightCursor(list_offsets[pixel], list_offsets[pixel + 1u]);
  COUNT_LISTED(cursor.end - cursor.next);
  return cursor;
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= cursor.end) return false;
  light = list_indices[cursor.next++];
  return true;
}

uint light_cell(SurfacePoint point) { return group_of_pixel(point.pixel, (view.resolution.x + 7u) / 8u, GROUP_PIXELS); }

LightCursor cell_begin(uint group, float depth, bool counted) {
  LightCursor cursor = LightCursor(group_offsets[group], group_offsets[group + 1u]);
  if (counted) COUNT_LISTED(cursor.end - cursor.next);
  return cursor;
}

#include "shaders/one_run.glsl"

uint run_light(uint entry) { return group_indices[entry]; }
