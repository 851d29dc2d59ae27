// Folds the albedo into the light that the shading pass left in two targets.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/constants.glsl"
#include "shaders/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = BIND_EMISSION) uniform sampler2D Emission;
layout(rgba32f, binding = BIND_RESULT) writeonly uniform image2D Result;
layout(rgba32f, binding = BIND_SPECULAR) readonly uniform image2D Specular;
layout(rgba32f, binding = BIND_DIFFUSE) readonly uniform image2D Diffuse;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, view.resolution))) return;
  // The sky has no albedo, and no light either.
  vec3 albedo = surface_albedo(texelFetch(Surface, ivec2(pixel), 0).y);
  vec3 light = albedo * imageLoad(Diffuse, ivec2(pixel)).rgb + imageLoad(Specular, ivec2(pixel)).rgb;
  if (EFFECT_EMISSION) light += texelFetch(Emission, ivec2(pixel), 0).rgb;
  imageStore(Result, ivec2(pixel), vec4(light, 1.0));
}
