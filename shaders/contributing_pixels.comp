// Every pixel against the lights that touch its block: counts them, or (FILL) writes them down in ascending order at
// the pixel's offset.
//
// The group's mask is narrowed to the block first, each thread taking words of its own; then all pixels walk the few
// lights that are left.
//
// Iterations for each chunk of 8192 lights, whatever the masks hold: 1 for the chunk, 4 x 33 to narrow it, 8 x 33 over
// the words that are left, and for the lights of each of these 256 words 32, or 4 where iterations are few
// (loop_iterations.glsl). So 28,000 lights take fewer than 35,000, and the 262,144 of one dispatch then fewer than
// 46,000.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/contributing_common.glsl"
#include "shaders/loop_iterations.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef FILL
layout(scalar, binding = 18) readonly buffer Offsets { uint offsets[]; };
layout(scalar, binding = 19) writeonly buffer Indices { uint indices[]; };
#endif
// Of the words so far.
layout(r32ui, binding = BIND_CONTRIBUTING) uniform uimage2D Contributing;
layout(r32ui, binding = BIND_HASH) uniform uimage2D Hash;

// Words of the mask that are narrowed at a time, and which of them have a light left (one bit a word).
const uint chunk_words = 256u;
shared uint narrowed[chunk_words];
shared uint occupied[chunk_words / 32u];

// Takes the lowest light out of the mask (which may be empty) and counts it if it contributes.
void take(SurfacePoint point, bool lit, uint base, inout uint mask, uint next, inout uint count, inout uint hash) {
  if (mask == 0u) return;
  uint light = base + uint(findLSB(mask));
  mask &= mask - 1u;
  LightSample from;
  if (!lit || !light_sample(point, light_at(light), from)) return;
#ifdef FILL
  indices[next + count] = light;
#endif
  count += 1u;
  hash += light_hash(light);
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  if (POISON_SHARED) {
    for (uint word = thread; word < chunk_words; word += 64u) narrowed[word] = poison_word;
    if (thread < chunk_words / 32u) occupied[thread] = poison_word;
    barrier();
  }
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
  if (push.first_word != 0u && inside) {
    count = imageLoad(Contributing, ivec2(pixel)).x;
    hash = imageLoad(Hash, ivec2(pixel)).x;
  }
#ifdef FILL
  uint next = lit ? offsets[pixel.y * view.resolution.x + pixel.x] : 0u;
#else
  uint next = 0u;
#endif
  for (uint chunk = push.first_word; chunk < push.end_word; chunk += chunk_words) {
    if (thread < chunk_words / 32u) occupied[thread] = 0u;
    barrier();
    for (uint word = thread; word < min(chunk_words, push.end_word - chunk); word += 64u) {
      uint kept = 0u;
      for (uint mask = masks[first_word + chunk + word]; mask != 0u; mask &= mask - 1u) {
        uint bit = uint(findLSB(mask));
        if (touches(light_at((chunk + word) * 32u + bit), box)) kept |= 1u << bit;
      }
      narrowed[word] = kept;
      if (kept != 0u) atomicOr(occupied[word / 32u], 1u << (word % 32u));
    }
    barrier();
    for (uint part = 0u; part < chunk_words / 32u; ++part)
      for (uint words = occupied[part]; words != 0u; words &= words - 1u) {
        uint word = part * 32u + uint(findLSB(words));
        uint mask = narrowed[word], base = (chunk + word) * 32u;
#define TAKE(n) take(point, lit, base, mask, next, count, hash);
        while (mask != 0u) {
          STEPS_OF_1(TAKE)
        }
#undef TAKE
      }
    barrier();
  }
  if (inside) {
    imageStore(Contributing, ivec2(pixel), uvec4(count));
    imageStore(Hash, ivec2(pixel), uvec4(hash));
  }
}
