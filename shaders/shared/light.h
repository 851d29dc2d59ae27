// Light data on the GPU. The core is all that an omni light needs (32 bytes, two to a cache line of 64); what
// only some shapes need stands in a second buffer of the same index, read only for those shapes.
#ifndef ML_SHARED_LIGHT_H
#define ML_SHARED_LIGHT_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct LightCore {
  vec3 position;   // m, camera-relative, world axes
  float radius;    // m
  vec3 intensity;  // W/sr
  uint id_shape;   // light index in the frame (24 bits) | shape << 24
};
ML_SIZE(LightCore, 32);

struct LightExtra {
  vec3 direction;    // unit, away from the light
  float cone_scale;  // cone factor = clamp(cos * scale + offset, 0, 1) squared
  float cone_offset;
  float cos_outer;  // contributes only where cos > cos_outer
  vec2 unused;
};
ML_SIZE(LightExtra, 32);

#define ML_SHAPE_OMNI 0u
#define ML_SHAPE_SPOT 1u
#define ML_LIGHT_ID_MASK 0xffffffu

ML_NAMESPACE_END
#endif
