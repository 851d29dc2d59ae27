// The camera of one frame, as the GPU and every algorithm's prepare() see it.
#ifndef ML_SHARED_VIEW_H
#define ML_SHARED_VIEW_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

// View space: x right, y up, z forward, metres. Everything is camera-relative: the camera is the origin of
// the world axes too.
struct ViewData {
  vec3 right;
  float left_edge;  // picture window: slopes at z = 1 (perspective) or metres (orthographic)
  vec3 up;
  float right_edge;
  vec3 forward;
  float bottom_edge;
  vec3 camera;  // m, relative to the scene's origin
  float top_edge;
  uvec2 resolution;   // px
  float near;         // m
  float far;          // m
  uint orthographic;  // 0 or 1
  uint light_count;
  float clip_far;  // m, surfaces farther than this are not seen; 0: there is no such distance
  uint unused;
};
ML_SIZE(ViewData, 96);

ML_NAMESPACE_END
#endif
