// Bounds of the surface points of every 8x8 block: one workgroup a block, one thread a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/contributing_common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
shared vec3 low[64], high[64];

void main() {
  uint i = gl_LocalInvocationIndex;
  uvec2 pixel = gl_WorkGroupID.xy * ML_BLOCK + gl_LocalInvocationID.xy;
  low[i] = vec3(3.0e38);
  high[i] = vec3(-3.0e38);
  SurfacePoint point;
  if (all(lessThan(pixel, view.resolution)) && surface_load(pixel, point)) low[i] = high[i] = point.position;
  for (uint step = 32u; step > 0u; step >>= 1) {
    barrier();
    if (i < step) {
      low[i] = min(low[i], low[i + step]);
      high[i] = max(high[i], high[i + step]);
    }
  }
  if (i == 0u) bounds[gl_WorkGroupID.y * push.blocks.x + gl_WorkGroupID.x] = BlockBounds(low[0], high[0]);
}
