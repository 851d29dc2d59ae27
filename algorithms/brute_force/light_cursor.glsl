// Every light of the dispatch's range, in order: of the whole frame, but where that is more than one dispatch looks at.
#ifdef FORWARD
const uint first_light = 0u;
uint end_light = view.light_count;
#endif

struct LightCursor {
  uint next;
};

LightCursor light_begin(SurfacePoint point) {
  COUNT_LISTED(end_light - first_light);
  return LightCursor(first_light);
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  light = cursor.next++;
  weight = 1.0;
  return light < end_light;
}
