// Whether something is seen in an 8x8 block: one workgroup a block, one thread a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, binding = 16) writeonly buffer Found { uint found[]; };
shared uint seen;

void main() {
  if (gl_LocalInvocationIndex == 0u) seen = 0u;
  barrier();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (all(lessThan(pixel, view.resolution)) && texelFetch(Depth, ivec2(pixel), 0).x > 0.0) atomicOr(seen, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u) found[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = seen;
}
