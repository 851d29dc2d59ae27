// DETAILED: levels with vertex colours, metallic-roughness textures or normal maps; EMISSION too: with surfaces that
// give light by themselves.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SURFACE_WRITER
#include "shaders/constants.glsl"
#include "shaders/surface.glsl"
#include "shaders/shared/material.h"
#ifdef DETAILED
#include "shaders/normal_map.glsl"
#endif

layout(push_constant, scalar) uniform Push { MaterialData material; };
layout(binding = BIND_BASE_COLOR) uniform sampler2D BaseColor;
layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec2 in_uv;
layout(location = 0) out uvec2 out_surface;
#ifdef FORWARD
layout(location = 1) out uint out_forward;  // number of the triangle, from 1, where it is lit forward; else 0
#endif
#ifdef DETAILED
layout(binding = BIND_METALLIC_ROUGHNESS) uniform sampler2D MetallicRoughness;
layout(binding = BIND_NORMAL_MAP) uniform sampler2D NormalMap;
layout(location = 2) in vec4 in_color;
layout(location = 3) in vec2 in_metallic_roughness_uv;
layout(location = 4) in vec4 in_tangent;
layout(location = 5) in vec2 in_normal_uv;
layout(location = 7) in vec3 in_relative;
#endif
#ifdef EMISSION
layout(binding = BIND_EMISSION_MAP) uniform sampler2D EmissionMap;
layout(location = 6) in vec2 in_emission_uv;
#ifdef FORWARD
layout(location = 2) out vec4 out_emission;
#else
layout(location = 1) out vec4 out_emission;
#endif
#endif

void main() {
  vec4 color = material.base_color * texture(BaseColor, in_uv);
  float roughness = material.roughness, metallic = material.metallic;
  // A normal of length 0 (or NaN) in a file must not become a NaN in the picture.
  float length_squared = dot(in_normal, in_normal);
  vec3 normal = length_squared > 1e-20 ? in_normal * inversesqrt(length_squared) : vec3(0.0, 1.0, 0.0);
#ifdef DETAILED
  // Everything that asks the pixels beside this one stands before the first branch.
  const vec4 factors = texture(MetallicRoughness, in_metallic_roughness_uv);
  const vec3 normal_texel = texture(NormalMap, in_normal_uv).xyz;
  const vec4 derived = derived_tangent(normal, in_relative, in_normal_uv);
  if ((material.details & ML_DETAIL_MATERIAL_BIT) != 0u) {
    color *= in_color;
    roughness *= factors.g;
    metallic *= factors.b;
  }
  if ((material.details & ML_DETAIL_NORMAL_BIT) != 0u)
    normal = mapped_normal(normal, in_tangent, derived, normal_texel, material.normal_scale);
#endif
#ifdef EMISSION
  out_emission = vec4(material.emission * texture(EmissionMap, in_emission_uv).rgb, 0.0);
#endif
  // Reversed depth without a far plane: near / z.
  if (EFFECT_CLIP_FAR && view.clip_far > 0.0 && gl_FragCoord.z * view.clip_far < view.near) discard;
  if (EFFECT_ALPHA_MASK && color.a < material.alpha_cutoff) discard;
  if (!gl_FrontFacing && material.double_sided != 0u) normal = -normal;
  out_surface = surface_pack(normal, color.rgb, roughness, metallic);
#ifdef FORWARD
  out_forward = material.forward_triangle == 0u ? 0u : material.forward_triangle + uint(gl_PrimitiveID);
#endif
}
