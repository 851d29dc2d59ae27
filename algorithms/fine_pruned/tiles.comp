// Step 2: the light list of one tile, by one workgroup of 64 threads with 2x2 pixels each. Coarse: every visible light's screen bounds against
// the tile's. Fine: the coarse lights' true volumes against the tile's pixels, 64 lights at a time.
//
// Order comes from bits: a batch of lights is tested into a bit field, and a light's place in the list is the number of bits before its own.
// So it depends neither on the order of threads nor on the width of a subgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "light_volume.glsl"
#include "pruned_lists.h"

layout(local_size_x = ML_PRUNED_GROUP) in;
layout(constant_id = 16) const uint MODE = 0u;
const uint mode_count = 0u;   // only counts the coarse lights
const uint mode_lists = 1u;   // writes the list at the place that offsets.comp found for it
const uint mode_packed = 2u;  // the chapter's 32 bytes and limits
layout(constant_id = 17) const bool FINE = true;

layout(scalar, binding = 16) readonly buffer Visible {
  VisibleHeader visible;
  uint visible_lights[];
};
layout(scalar, binding = 17) readonly buffer Bounds { ScreenBounds bounds[]; };
layout(scalar, binding = 18) buffer TileLists { uvec2 tile_lists[]; };  // first light and count
layout(scalar, binding = 19) writeonly buffer ListLights { uint list_lights[]; };
layout(scalar, binding = 20) writeonly buffer PackedLists { uint packed_lists[]; };
layout(scalar, binding = 21) writeonly buffer TileCounts { uvec2 tile_counts[]; };  // lights before and after fine pruning
layout(scalar, push_constant) uniform Push { PrunedPush push; };

const uint rounds = 8u;  // lights that a thread tests in one batch
const uint batch = rounds * ML_PRUNED_GROUP, batch_words = batch / 32u;

shared uint depth_low, depth_high;            // bits of the tile's depths, which are positive and so in order
shared uint passed[3u * batch_words];         // which lights of a batch passed; three take turns, so that a barrier a batch is enough
shared uint coarse[ML_PRUNED_CHUNK + batch];  // visible indices of coarse lights, in order
shared uint survivors[2];                     // which of a chunk's lights hold a pixel
shared uint kept[ML_PACKED_LIGHTS];

FourPoints points;
ScreenBounds tile_bounds;

// Pixels of a partial tile that lie outside the picture repeat its last row or column.
void load_points() {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 corner = gl_WorkGroupID.xy * ML_PRUNED_TILE;
  const uvec2 first = corner + 2u * uvec2(thread & 7u, thread >> 3), last = view.resolution - 1u;
  if (thread == 0u) {
    depth_low = 0xffffffffu;
    depth_high = 0u;
  }
  barrier();
  for (uint i = 0u; i < 4u; ++i) {
    const uvec2 pixel = min(first + uvec2(i & 1u, i >> 1), last);
    const float reversed = texelFetch(Depth, ivec2(pixel), 0).x;
    points.lit[i] = reversed > 0.0;
    if (!points.lit[i]) continue;
    const float depth = depth_from_reversed(reversed);
    const vec3 position = position_from_depth(pixel, depth);
    points.x[i] = position.x;
    points.y[i] = position.y;
    points.z[i] = position.z;
    const uint bits = floatBitsToUint(max(depth, 0.0));
    atomicMin(depth_low, bits);
    atomicMax(depth_high, bits);
  }
  barrier();
  const uvec2 edge = min(corner + ML_PRUNED_TILE - 1u, last);
  tile_bounds = ScreenBounds(corner.x | edge.x << 16, corner.y | edge.y << 16, uintBitsToFloat(depth_low), uintBitsToFloat(depth_high));
}

// Closed ranges, as first | last << 16.
bool ranges_meet(uint a, uint b) { return (a & 0xffffu) <= b >> 16 && (b & 0xffffu) <= a >> 16; }

bool overlaps(ScreenBounds light) {
  return ranges_meet(light.x, tile_bounds.x) && ranges_meet(light.y, tile_bounds.y) && light.far >= tile_bounds.near &&
         light.near <= tile_bounds.far;
}

// How many of the chunk's lights, of which there are at most 64, come before a visible index.
uint lights_before(uint begin, uint count, uint value) {
  uint at = 0u;
#define STEP(size) \
  if (at + size <= count && coarse[begin + at + size - 1u] < value) at += size;
  STEP(64u)
  STEP(32u)
  STEP(16u)
  STEP(8u)
  STEP(4u)
  STEP(2u)
  STEP(1u)
#undef STEP
  return at;
}

// One loop for each type of volume. Several lights a turn where there are many: some drivers are short of turns (shaders/light_eval.glsl).
#define PRUNE(volume, end, at)                                                               \
  if (at < end && volume(points, lights[visible_lights[coarse[begin + at]]])) {              \
    if (at < 32u)                                                                            \
      mask.x |= 1u << at;                                                                    \
    else                                                                                     \
      mask.y |= 1u << (at - 32u);                                                            \
  }
#define PRUNE_LOOP(volume, from, end)                                                        \
  for (uint i = from; i < end; i += LONG_LISTS ? 8u : 2u) {                                  \
    PRUNE(volume, end, i)                                                                    \
    PRUNE(volume, end, (i + 1u))                                                             \
    if (LONG_LISTS) {                                                                        \
      PRUNE(volume, end, (i + 2u))                                                           \
      PRUNE(volume, end, (i + 3u))                                                           \
      PRUNE(volume, end, (i + 4u))                                                           \
      PRUNE(volume, end, (i + 5u))                                                           \
      PRUNE(volume, end, (i + 6u))                                                           \
      PRUNE(volume, end, (i + 7u))                                                           \
    }                                                                                        \
  }

// Which of the coarse lights begin .. begin + count, at most 64, hold a pixel of the tile. The coarse list was written before a barrier that
// all threads have passed.
uvec2 prune(uint begin, uint count) {
  if (!FINE) return uvec2(count < 32u ? (1u << count) - 1u : 0xffffffffu,
                          count < 32u ? 0u : count < 64u ? (1u << (count - 32u)) - 1u : 0xffffffffu);
  if (gl_LocalInvocationIndex < 2u) survivors[gl_LocalInvocationIndex] = 0u;
  barrier();
  const uint cones = lights_before(begin, count, visible.first_cone), boxes = lights_before(begin, count, visible.first_box);
  uvec2 mask = uvec2(0u);
  if (any(points.lit)) {
    PRUNE_LOOP(in_ball, 0u, cones)
    PRUNE_LOOP(in_cone, cones, boxes)
    PRUNE_LOOP(in_box_volume, boxes, count)
  }
  if (mask.x != 0u) atomicOr(survivors[0], mask.x);
  if (mask.y != 0u) atomicOr(survivors[1], mask.y);
  barrier();
  mask = uvec2(survivors[0], survivors[1]);
  barrier();
  return mask;
}

uint bits_before(uvec2 mask, uint place) {
  return place < 32u ? uint(bitCount(mask.x & ((1u << place) - 1u)))
                     : uint(bitCount(mask.x) + bitCount(mask.y & ((1u << (place - 32u)) - 1u)));
}

bool has_bit(uvec2 mask, uint place) { return ((place < 32u ? mask.x >> place : mask.y >> (place - 32u)) & 1u) != 0u; }

// Prunes a chunk and appends what is left to the tile's list.
void append_chunk(uint begin, uint count, uint first, inout uint listed) {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 mask = prune(begin, count);
  if (has_bit(mask, thread)) {
    const uint place = listed + bits_before(mask, thread);
    if (MODE == mode_lists) list_lights[first + place] = visible_lights[coarse[begin + thread]];
    if (MODE == mode_packed && place < ML_PACKED_LIGHTS) kept[place] = coarse[begin + thread];
  }
  listed += bitCount(mask.x) + bitCount(mask.y);
}

// Coarse lights of the batch from `first_light` on, as bits of passed[field ...].
void test_batch(uint first_light, uint field) {
  const uint thread = gl_LocalInvocationIndex;
  for (uint round = 0u; round < rounds; ++round) {
    const uint place = first_light + round * ML_PRUNED_GROUP + thread;
    if (place < visible.count && overlaps(bounds[place])) atomicOr(passed[field + round * 2u + (thread >> 5)], 1u << (thread & 31u));
  }
}

// Appends the lights that passed to coarse[], as far as it holds them; how many they were.
uint keep_batch(uint first_light, uint field, uint held) {
  const uint thread = gl_LocalInvocationIndex;
  uint before = held;
  for (uint round = 0u; round < rounds; ++round) {
    const uvec2 mask = uvec2(passed[field + round * 2u], passed[field + round * 2u + 1u]);
    if (MODE != mode_count && has_bit(mask, thread)) {
      const uint place = before + bits_before(mask, thread);
      if (MODE == mode_lists || place < ML_PRUNED_CHUNK) coarse[place] = first_light + round * ML_PRUNED_GROUP + thread;
    }
    before += bitCount(mask.x) + bitCount(mask.y);
  }
  return before - held;
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint tile = gl_WorkGroupID.y * push.columns + gl_WorkGroupID.x;
  if (thread < batch_words)
    for (uint turn = 0u; turn < 3u; ++turn) passed[turn * batch_words + thread] = 0u;
  load_points();

  const uint first = MODE == mode_lists ? tile_lists[tile].x : 0u;
  const bool no_room = MODE == mode_lists && first == ML_PRUNED_ALL;
  // A tile of sky has an empty list.
  const uint count = no_room || !(tile_bounds.near <= tile_bounds.far) ? 0u : visible.count;
  uint demand = 0u, held = 0u, listed = 0u, turn = 0u;
  for (uint begin = 0u; begin < count; begin += batch) {
    const uint field = turn * batch_words;
    test_batch(begin, field);
    barrier();
    const uint more = keep_batch(begin, field, held);
    // Last read before this batch's barrier, and next written after the next one's.
    const uint cleared = turn == 0u ? 2u : turn - 1u;
    if (thread < batch_words) passed[cleared * batch_words + thread] = 0u;
    turn = turn == 2u ? 0u : turn + 1u;
    demand += more;
    held += more;
    if (MODE == mode_lists && held >= ML_PRUNED_CHUNK) {
      barrier();
      uint done = 0u;
      for (; held - done >= ML_PRUNED_CHUNK; done += ML_PRUNED_CHUNK) append_chunk(done, ML_PRUNED_CHUNK, first, listed);
      held -= done;
      const uint rest = thread < held ? coarse[done + thread] : 0u;
      barrier();
      if (thread < held) coarse[thread] = rest;
    }
  }
  if (MODE == mode_count) {
    if (thread == 0u) tile_counts[tile] = uvec2(demand, 0u);
    return;
  }
  barrier();
  held = min(held, ML_PRUNED_CHUNK);
  if (held != 0u) append_chunk(0u, held, first, listed);
  if (MODE == mode_lists && no_room) listed = visible.count;
  if (thread == 0u) {
    if (MODE == mode_packed) tile_counts[tile].x = demand;  // else counted before
    tile_counts[tile].y = listed;
    if (MODE == mode_lists) tile_lists[tile].y = listed;
  }
  if (MODE != mode_packed) return;
  barrier();
  if (thread < ML_PACKED_WORDS) {
    const uint stored = min(listed, ML_PACKED_LIGHTS), begin = 3u * thread, words_lights = stored > begin ? min(stored - begin, 3u) : 0u;
    packed_lists[tile * ML_PACKED_WORDS + thread] =
        packed_word(words_lights > 0u ? kept[begin] : 0u, words_lights > 1u ? kept[begin + 1u] : 0u,
                    words_lights > 2u ? kept[begin + 2u] : 0u, words_lights);
  }
}
