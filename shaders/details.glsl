// What vertex shaders read of a vertex beyond its attributes: the buffer Details, laid out as shared/material.h says.
#ifndef ML_DETAILS_GLSL
#define ML_DETAILS_GLSL
#include "shaders/bindings.glsl"
#include "shaders/shared/material.h"

#ifdef MOVING
#include "shaders/motion.glsl"
#else
layout(push_constant, scalar) uniform Push { MaterialData material; };
#endif
layout(scalar, binding = BIND_DETAILS) readonly buffer Details { uint details[]; };

// The two words of a detail; `missing` where the level has none of that kind.
uvec2 detail_words(uint kind, uvec2 missing) {
  const uint from_one = bitfieldExtract(material.details, int(kind), 4);
  if (from_one == 0u) return missing;
  const uint word = bitfieldExtract(material.details, 0, 4) * uint(gl_VertexIndex) + from_one - 1u;
  return uvec2(details[word], details[word + 1u]);
}

vec4 detail_color() {
  const uint one_one = 0x3c003c00u;  // twice 1 in half floats
  const uvec2 words = detail_words(ML_DETAIL_COLOR, uvec2(one_one));
  return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

vec4 detail_tangent() {
  const uvec2 words = detail_words(ML_DETAIL_TANGENT, uvec2(0u));
  return vec4(unpackSnorm2x16(words.x), unpackSnorm2x16(words.y));
}

vec2 detail_uv(uint kind, vec2 missing) {
  return uintBitsToFloat(detail_words(kind, floatBitsToUint(missing)));
}

#endif
