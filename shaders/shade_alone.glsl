// The shading loop of a pixel that walks its lights by itself. Included by shade.comp.
#ifndef ML_SHADE_ALONE_GLSL
#define ML_SHADE_ALONE_GLSL
#include "shaders/loop_iterations.glsl"

#define SHADE_NEXT(next_light)                                    \
  if (!next_light(cursor, light, weight)) break;                  \
  if (light != no_light) {                                        \
    data = CURSOR_LIGHT(light);                                   \
    if (test_light(point, data, from)) add_light(point, data, from, weight, sum); \
  }
// Every pixel first looks for its next light that contributes, then all shade theirs: so the costly part runs about as
// often as lights contribute and not as often as they are tested, also where a processor runs its lanes in step. Or one
// loop does both.
#define SHADE_LOOP(next_light)                                    \
  if (loops_in_loops) {                                           \
    while (true) {                                                \
      bool found = false;                                         \
      while (!found) {                                            \
        if (!next_light(cursor, light, weight)) break;            \
        if (light == no_light) continue;                          \
        data = CURSOR_LIGHT(light);                               \
        found = test_light(point, data, from);                    \
      }                                                           \
      if (!found) break;                                          \
      data.intensity = CURSOR_LIGHT(light).intensity;             \
      add_light(point, data, from, weight, sum);                  \
      if (!CURSOR_MORE(cursor)) break;                            \
    }                                                             \
  } else {                                                        \
    while (true) {                                                \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
      SHADE_NEXT(next_light)                                      \
    }                                                             \
  }

void shade_alone(SurfacePoint point, inout VEC3 sum) {
  LightCursor cursor = light_begin(point);
  uint light;
  float weight;
  LightCore data;
  LightSample from;
#ifdef CURSOR_CASES
  uint walk = cursor_case(cursor);
  if (walk == 0u) {
    SHADE_LOOP(light_next_in_list)
  } else if (walk == 1u) {
    SHADE_LOOP(light_next_shared)
  } else {
    SHADE_LOOP(light_next)
  }
#else
  SHADE_LOOP(light_next)
#endif
}

#endif
