// Light data on the GPU. The core is all that an omni light needs (32 bytes, two to a cache line of 64); what
// only some shapes need stands in a second buffer of the same index, read only for those shapes. What each
// shape is: harness/scene/light.h.
#ifndef ML_SHARED_LIGHT_H
#define ML_SHARED_LIGHT_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct LightCore {
  vec3 position;   // m, camera-relative, world axes
  float radius;    // m, of the window; boxes: their half diagonal, which no formula of theirs needs
  vec3 intensity;  // W/sr; probe lights: W/m^2
  uint id_shape;   // light index in the frame (23 bits) | probe << 23 | shape << 24
};
ML_SIZE(LightCore, 32);

// The fields that a shape has no use for hold what changes nothing: half_length 0, a cone factor of 1. Boxes
// keep their half extents in half_length, cone_scale and cone_limit: read them through box_half_extents().
struct LightExtra {
  vec3 direction;     // unit, away from the light: spots, wedges, boxes; else 0
  float half_length;  // m, of the source segment: capsules, wedges; else 0 | boxes: half extent along `side`
  vec3 side;          // unit, across `direction`: capsules, wedges, boxes; else 0
  // Cone factor = clamp((limit - (1 - cos)) * scale, 0, 1) squared, cos of the angle off `direction`: as 1 -
  // cos narrow cones keep their digits.
  float cone_scale;    // | boxes: along box_up()
  float cone_limit;    // 1 - cos of the outer angle | boxes: along `direction`
  float cos_outer;     // for bounds, which widen it by what rounding may take
  float bound_radius;  // m: no contribution beyond it from `position`, whatever the shape
  float spare;         // 0
};
ML_SIZE(LightExtra, 48);

#define ML_SHAPE_OMNI 0u
#define ML_SHAPE_SPOT 1u
#define ML_SHAPE_CAPSULE 2u
#define ML_SHAPE_WEDGE 3u
#define ML_SHAPE_BOX 4u
#define ML_LIGHT_ID_MASK 0x7fffffu
#define ML_LIGHT_PROBE 0x800000u

// m, along side, box_up() and direction.
ML_FUNCTION vec3 box_half_extents(LightExtra extra) {
  return vec3(extra.half_length, extra.cone_scale, extra.cone_limit);
}

// The third axis of a box: side, box_up() and direction are right-handed.
ML_FUNCTION vec3 box_up(LightExtra extra) {
  return cross(extra.direction, extra.side);
}

ML_NAMESPACE_END
#endif
