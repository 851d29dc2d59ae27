// Every light of the frame, in order.
struct LightCursor {
  uint next;
};

LightCursor light_begin(SurfacePoint point) {
  COUNT_LISTED(view.light_count);
  return LightCursor(0u);
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  light = cursor.next++;
  weight = 1.0;
  return light < view.light_count;
}
