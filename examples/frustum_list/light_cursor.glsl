// Every pixel walks the same list.
layout(scalar, binding = 16) readonly buffer List { uint list_length_data; uint list_lights[]; };
uint list_length = list_length_data;  // read once, before all branches

struct LightCursor {
  uint next;
};

LightCursor light_begin(SurfacePoint point) {
  COUNT_LISTED(list_length);
  return LightCursor(0u);
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= list_length) return false;
  light = list_lights[cursor.next++];
  return true;
}
