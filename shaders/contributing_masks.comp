// For every group of 8x8 blocks a bit for each light that touches one of its blocks' common bounds: one workgroup a
// group.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/contributing_common.glsl"

layout(local_size_x = 64) in;
shared vec3 low[64], high[64];

void main() {
  uint i = gl_LocalInvocationIndex;
  if (POISON_SHARED) {
    low[i] = high[i] = vec3(uintBitsToFloat(poison_word));
    barrier();
  }
  uvec2 block = gl_WorkGroupID.xy * ML_GROUP + uvec2(i % ML_GROUP, i / ML_GROUP);
  low[i] = vec3(3.0e38);
  high[i] = vec3(-3.0e38);
  if (all(lessThan(block, push.blocks))) {
    BlockBounds box = bounds[block.y * push.blocks.x + block.x];
    low[i] = box.low;
    high[i] = box.high;
  }
  for (uint step = 32u; step > 0u; step >>= 1) {
    barrier();
    if (i < step) {
      low[i] = min(low[i], low[i + step]);
      high[i] = max(high[i], high[i + step]);
    }
  }
  barrier();
  BlockBounds box = BlockBounds(low[0], high[0]);
  uint first_word = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * push.mask_words;
  for (uint word = i; word < push.mask_words; word += 64u) {
    uint mask = 0u;
    for (uint bit = 0u; bit < 32u; ++bit) {
      uint light = word * 32u + bit;
      if (light < view.light_count && touches(light_at(light), box)) mask |= 1u << bit;
    }
    masks[first_word + word] = mask;
  }
}
