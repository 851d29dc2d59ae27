// Lights tested against bounds 512 at a time by a workgroup of 64 threads, and their ranks among those that passed.
// Who includes this says what the candidates are: `uint candidate(uint index)`, a visible index.
#ifndef ML_FINE_PRUNED_LIGHT_BATCHES_GLSL
#define ML_FINE_PRUNED_LIGHT_BATCHES_GLSL
#include "group_votes.glsl"
#include "pruned_lists.h"
#include "shaders/quads.glsl"

layout(constant_id = 34) const bool TILE_DEPTHS = true;  // false: tiles have no bounds in depth

layout(scalar, binding = 16) readonly buffer Visible {
  VisibleHeader visible_data;
  uint visible_lights[];
};
VisibleHeader visible = visible_data;  // read before all branches, as the view is (shaders/surface.glsl)
layout(scalar, binding = 17) readonly buffer Bounds { ScreenBounds bounds[]; };
QUADS(BoundsQuads, 17);

ScreenBounds bounds_of(uint light) {
  if (!TEXEL_FETCH) return bounds[light];
  const uvec4 words = texelFetch(BoundsQuads, int(light));
  return ScreenBounds(words.x, words.y, uintBitsToFloat(words.z), uintBitsToFloat(words.w));
}

const uint max_rounds = 8u;  // lights that a thread tests in one batch
const uint batch = max_rounds * ML_PRUNED_GROUP, batch_words = batch / 32u;

// Which lights of a batch passed. There are three slots, used one after the other, so that a barrier a batch is enough.
shared uint passed[3u * batch_words];

// Before anything that is shared is written; the pass then does the same with what it shares itself, and a barrier
// follows.
void poison_batches() {
  if (gl_LocalInvocationIndex == 0u) depth_low = depth_high = poison_word;
  for (uint i = gl_LocalInvocationIndex; i < 3u * batch_words; i += ML_PRUNED_GROUP) passed[i] = poison_word;
}

// Before the first batch, and a barrier before it.
void clear_batches() {
  const uint thread = gl_LocalInvocationIndex;
  if (thread < batch_words)
    for (uint slot = 0u; slot < 3u; ++slot) passed[slot * batch_words + thread] = 0u;
}

// After a batch's barrier: clears the slot that was last read before it, and is next written after the barrier of the
// next batch. Returns the next batch's slot.
uint next_slot(uint slot) {
  const uint cleared = slot == 0u ? 2u : slot - 1u;
  if (gl_LocalInvocationIndex < batch_words) passed[cleared * batch_words + gl_LocalInvocationIndex] = 0u;
  return slot == 2u ? 0u : slot + 1u;
}

// Closed ranges, as first | last << 16.
bool ranges_meet(uint a, uint b) { return (a & 0xffffu) <= b >> 16 && (b & 0xffffu) <= a >> 16; }

bool overlaps(ScreenBounds light, ScreenBounds area) {
  return ranges_meet(light.x, area.x) && ranges_meet(light.y, area.y) &&
         (!TILE_DEPTHS || light.far >= area.near && light.near <= area.far);
}

// Rounds of the batch that begins at candidate `first` in which there are candidates before `count`.
uint rounds_of(uint first, uint count) {
  return min((count - first + ML_PRUNED_GROUP - 1u) / ML_PRUNED_GROUP, max_rounds);
}

// Those of the batch of candidates from `first` on, and before `count`, that overlap: as bits of passed[field ...].
void test_batch(uint first, uint count, uint field, ScreenBounds area) {
  const uint thread = gl_LocalInvocationIndex, rounds = rounds_of(first, count);
  for (uint round = 0u; round < rounds; ++round) {
    const uint at = first + round * ML_PRUNED_GROUP + thread;
    const uint bit = at < count && overlaps(bounds_of(candidate(at)), area) ? 1u << (thread & 31u) : 0u;
    SET_BITS(passed[field + round * 2u], (thread < 32u ? bit : 0u))
    SET_BITS(passed[field + round * 2u + 1u], (thread < 32u ? 0u : bit))
  }
}

uvec2 passed_in(uint field, uint round) { return uvec2(passed[field + round * 2u], passed[field + round * 2u + 1u]); }

uint bits_before(uvec2 mask, uint bit) {
  return bit < 32u ? uint(bitCount(mask.x & ((1u << bit) - 1u)))
                   : uint(bitCount(mask.x) + bitCount(mask.y & ((1u << (bit - 32u)) - 1u)));
}

bool has_bit(uvec2 mask, uint bit) { return ((bit < 32u ? mask.x >> bit : mask.y >> (bit - 32u)) & 1u) != 0u; }

#endif
