// The forward pass: meshes of forward materials, drawn again with equal depth, light themselves from the lists that the
// deferred pass walks. Included by shade.comp.
//
// A pixel belongs to the triangle whose number the g-buffer pass left there, so that it is lit once also where
// triangles lie in one another. Depth and normal are the g-buffer's, for every pass must decide alike which lights
// contribute; the material is the mesh's own.
#ifndef ML_SHADE_FORWARD_GLSL
#define ML_SHADE_FORWARD_GLSL
#include "shaders/shared/material.h"

layout(early_fragment_tests) in;
layout(push_constant, scalar) uniform Push { MaterialData material; };
layout(binding = BIND_BASE_COLOR) uniform sampler2D BaseColor;
layout(binding = BIND_METALLIC_ROUGHNESS) uniform sampler2D MetallicRoughness;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_color;
layout(location = 3) in vec2 in_metallic_roughness_uv;
layout(location = 0) out vec4 out_result;

void main() {
  const uvec2 pixel = uvec2(gl_FragCoord.xy);
  vec4 color = material.base_color * texture(BaseColor, in_uv);
  const vec4 factors = texture(MetallicRoughness, in_metallic_roughness_uv);
  float roughness = material.roughness, metallic = material.metallic;
  if ((material.details & ML_DETAIL_MATERIAL_BIT) != 0u) {
    color *= in_color;
    roughness *= factors.g;
    metallic *= factors.b;
  }
  const bool own = texelFetch(Forward, ivec2(pixel), 0).x == material.forward_triangle + uint(gl_PrimitiveID);
  VEC3 sum = VEC3(0);
  if (own) {
    const uint normal_mask = 0xffffffu;
    // As coarse as in the g-buffer: forced off, the effect leaves the same picture.
    uvec2 word = surface_pack(vec3(0.0, 0.0, 1.0), color.rgb, roughness, metallic);
    word.x = (word.x & ~normal_mask) | (texelFetch(Surface, ivec2(pixel), 0).x & normal_mask);
    SurfacePoint point;
    surface_unpack(pixel, gl_FragCoord.z, word, point);
    shade_alone(point, sum);
  }
  if (!own) discard;
  if (EFFECT_EMISSION) sum += VEC3(texelFetch(Emission, ivec2(pixel), 0).rgb);
  out_result = vec4(sum, 1.0);
#ifdef COUNTING
  // On top of what the deferred pass left, which is 0: a pixel that were lit twice would have every light twice.
  imageAtomicAdd(Listed, ivec2(pixel), count_listed);
  imageAtomicAdd(Tested, ivec2(pixel), count_tested);
  imageAtomicAdd(Contributing, ivec2(pixel), count_contributing);
  imageAtomicAdd(Nodes, ivec2(pixel), count_nodes);
  imageAtomicAdd(Hash, ivec2(pixel), count_hash);
  imageAtomicAdd(Traversal, ivec2(pixel), count_traversal);
#ifdef CURSOR_COUNTERS
  store_counters(ivec2(pixel));
#endif
#endif
}

#endif
