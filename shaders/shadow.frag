// Shadow maps of cut-out materials; others need no fragment shader.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/bindings.glsl"
#include "shaders/shared/material.h"

layout(push_constant, scalar) uniform Push { MaterialData material; };
layout(binding = BIND_BASE_COLOR) uniform sampler2D BaseColor;
layout(location = 0) in vec2 in_uv;
#ifdef DETAILED
layout(location = 1) in float in_alpha;  // of the vertex colour
#endif

void main() {
  float alpha = material.base_color.a * texture(BaseColor, in_uv).a;
#ifdef DETAILED
  if ((material.details & ML_DETAIL_MATERIAL_BIT) != 0u) alpha *= in_alpha;
#endif
  if (alpha < material.alpha_cutoff) discard;
}
