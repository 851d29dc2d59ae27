// Writes what the shading loop sees of every pixel, for checking with other programs: KIND 0 position, 1 normal, 2
// albedo, 3 material (roughness, metallic), 4 emission, each with the view depth in the fourth channel (0: sky).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 32) const uint KIND = 0u;
layout(binding = BIND_EMISSION) uniform sampler2D Emission;
layout(rgba32f, binding = BIND_RESULT) writeonly uniform image2D Result;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, view.resolution))) return;
  SurfacePoint point;
  vec4 value = vec4(0.0);
  if (surface_load(pixel, point)) {
    if (KIND == 0u) value.xyz = point.position;
    if (KIND == 1u) value.xyz = point.normal;
    if (KIND == 2u) value.xyz = point.albedo;
    if (KIND == 3u) value.xy = vec2(point.roughness, point.metallic);
    if (KIND == 4u) value.xyz = texelFetch(Emission, ivec2(pixel), 0).rgb;
    value.w = point.depth;
  }
  imageStore(Result, ivec2(pixel), value);
}
