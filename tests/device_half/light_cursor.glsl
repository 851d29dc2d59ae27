// All lights of the frame, and a counter of the algorithm's own: how often a pixel asked.
struct LightCursor {
  uint next;
};

#ifdef COUNTING
layout(r32ui, binding = 16) writeonly uniform uimage2D asked;
uint count_asked = 0u;
void store_counters(ivec2 pixel) { imageStore(asked, pixel, uvec4(count_asked)); }
#define CURSOR_COUNTERS
#define COUNT_ASKED() (++count_asked)
#else
#define COUNT_ASKED()
#endif

LightCursor light_begin(SurfacePoint point) {
  COUNT_LISTED(view.light_count);
  return LightCursor(0u);
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  COUNT_ASKED();
  weight = 1.0;
  if (cursor.next >= view.light_count) return false;
  light = cursor.next++;
  return true;
}
