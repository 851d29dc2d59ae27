// Bounds arithmetic of the passes that find the contributing lights.
#ifndef ML_CONTRIBUTING_COMMON_GLSL
#define ML_CONTRIBUTING_COMMON_GLSL
#include "shaders/light_eval.glsl"
#include "shaders/shared/contributing.h"

layout(push_constant, scalar) uniform Push { ContributingPush push; };
layout(scalar, binding = 16) buffer Bounds { BlockBounds bounds[]; };
layout(scalar, binding = 17) buffer Masks { uint masks[]; };

// Whether the ball around the light's volume touches the box; widened by 1e-5, far more than rounding can take away.
// False for an empty box.
bool touches(LightCore light, BlockBounds box) {
  vec3 outside = max(max(box.low - light.position, light.position - box.high), vec3(0.0));
  float reach = light_bound(light);
  return box.low.x <= box.high.x && dot(outside, outside) <= reach * reach * 1.00001;
}

#endif
