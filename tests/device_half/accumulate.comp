// After shading: the sum of all pictures since the last cut, and in its fourth channel how many they are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = BIND_RESULT) readonly uniform image2D Result;
layout(r32ui, binding = 16) readonly uniform uimage2D Marks;
layout(rgba32f, binding = 17) writeonly uniform image2D Sum;
layout(rgba32f, binding = 18) readonly uniform image2D SumBefore;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(pixel), view.resolution)) || imageLoad(Marks, pixel).x == 0u) return;
  imageStore(Sum, pixel, imageLoad(SumBefore, pixel) + vec4(imageLoad(Result, pixel).rgb, 1.0));
}
