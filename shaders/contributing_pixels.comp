// Every pixel against the lights that touch its block: counts them, or (FILL) writes them down in ascending order at the pixel's offset.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/contributing_common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef FILL
layout(scalar, binding = 18) readonly buffer Offsets { uint offsets[]; };
layout(scalar, binding = 19) writeonly buffer Indices { uint indices[]; };
#else
layout(r32ui, binding = BIND_CONTRIBUTING) writeonly uniform uimage2D Contributing;
layout(r32ui, binding = BIND_HASH) writeonly uniform uimage2D Hash;
#endif

void main() {
  uvec2 block = gl_WorkGroupID.xy;
  uvec2 pixel = block * ML_BLOCK + gl_LocalInvocationID.xy;
  BlockBounds box = bounds[block.y * push.blocks.x + block.x];
  uvec2 group = block / ML_GROUP;
  uint groups_across = (push.blocks.x + ML_GROUP - 1u) / ML_GROUP;
  uint first_word = (group.y * groups_across + group.x) * push.mask_words;

  SurfacePoint point;
  bool inside = all(lessThan(pixel, view.resolution));
  bool lit = inside && surface_load(pixel, point);
  uint count = 0u, hash = 0u;
#ifdef FILL
  uint next = lit ? offsets[pixel.y * view.resolution.x + pixel.x] : 0u;
#endif
  for (uint word = 0u; word < push.mask_words; ++word) {
    for (uint mask = masks[first_word + word]; mask != 0u; mask &= mask - 1u) {
      uint light = word * 32u + uint(findLSB(mask));
      LightCore data = lights[light];
      if (!touches(data, box)) continue;
      LightSample from;
      if (lit && light_sample(point, data, from)) {
#ifdef FILL
        indices[next + count] = light;
#endif
        count += 1u;
        hash += light_hash(light);
      }
    }
  }
#ifndef FILL
  if (inside) {
    imageStore(Contributing, ivec2(pixel), uvec4(count));
    imageStore(Hash, ivec2(pixel), uvec4(hash));
  }
#endif
}
