// Shadow maps of cut-out materials; others need no fragment shader.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/shared/material.h"

layout(push_constant, scalar) uniform Push { MaterialData material; };
layout(binding = 2) uniform sampler2D BaseColor;
layout(location = 0) in vec2 in_uv;

void main() {
  if (material.base_color.a * texture(BaseColor, in_uv).a < material.alpha_cutoff) discard;
}
