#version 460
#extension GL_GOOGLE_include_directive : require
#define SURFACE_WRITER
#include "shaders/surface.glsl"
#include "shaders/shared/material.h"

layout(constant_id = 0) const bool EFFECT_ALPHA_MASK = false;
layout(constant_id = 1) const bool EFFECT_CLIP_FAR = false;  // the camera of some frame has a far plane
layout(push_constant, scalar) uniform Push { MaterialData material; };
layout(binding = 2) uniform sampler2D BaseColor;
layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec2 in_uv;
layout(location = 0) out uvec2 out_surface;
#ifdef FORWARD
layout(location = 1) out uint out_forward;  // number of the triangle, from 1, where it is lit forward; else 0
#endif

void main() {
  // Reversed depth without a far plane: near / z.
  if (EFFECT_CLIP_FAR && view.clip_far > 0.0 && gl_FragCoord.z * view.clip_far < view.near) discard;
  vec4 color = material.base_color * texture(BaseColor, in_uv);
  if (EFFECT_ALPHA_MASK && color.a < material.alpha_cutoff) discard;
  // A normal of length 0 (or NaN) in a file must not become a NaN in the picture.
  float length_squared = dot(in_normal, in_normal);
  vec3 normal = length_squared > 1e-20 ? in_normal * inversesqrt(length_squared) : vec3(0.0, 1.0, 0.0);
  if (!gl_FrontFacing && material.double_sided != 0u) normal = -normal;
  out_surface = surface_pack(normal, color.rgb, material.roughness, material.metallic);
#ifdef FORWARD
  out_forward = material.forward_triangle == 0u ? 0u : material.forward_triangle + uint(gl_PrimitiveID);
#endif
}
