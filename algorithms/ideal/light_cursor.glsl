// The pixel's own list of contributing lights.
layout(scalar, binding = 16) readonly buffer ListOffsets { uint list_offsets[]; };
layout(scalar, binding = 17) readonly buffer ListIndices { uint list_indices[]; };

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
#define CURSOR_MORE(cursor) ((cursor).next < (cursor).end)
