// What the picture answers to each query. Without a define a sample; SHADOW: a comparison; FETCH: a texel.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
#if defined(SHADOW)
layout(binding = 0) uniform sampler2DShadow picture;
#elif defined(UINT)
layout(binding = 0) uniform usampler2D picture;
#else
layout(binding = 0) uniform sampler2D picture;
#endif
struct Query {
  vec2 at;  // 0 to 1, or the texel
  float depth;
  float level;
};
layout(scalar, binding = 1) readonly buffer Queries { Query queries[]; };
layout(scalar, binding = 2) writeonly buffer Answers { uvec4 answers[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Query query = queries[i];
#if defined(SHADOW)
  answers[i] = floatBitsToUint(vec4(textureLod(picture, vec3(query.at, query.depth), query.level)));
#elif defined(UINT)
  answers[i] = texelFetch(picture, ivec2(query.at), int(query.level));
#elif defined(FETCH)
  answers[i] = floatBitsToUint(texelFetch(picture, ivec2(query.at), int(query.level)));
#else
  answers[i] = floatBitsToUint(textureLod(picture, query.at, query.level));
#endif
}
