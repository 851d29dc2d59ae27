// Before shading: marks pixels that see something, and counts them for all that follows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 32) const uint MARK = 0u;
layout(r32ui, binding = 16) writeonly uniform uimage2D Marks;
layout(scalar, binding = 17) buffer Seen { uint seen; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  SurfacePoint point;
  if (any(greaterThanEqual(pixel, view.resolution))) return;
  const bool lit = surface_load(pixel, point);
  imageStore(Marks, ivec2(pixel), uvec4(lit ? MARK : 0u));
  if (lit) atomicAdd(seen, 1u);
}
