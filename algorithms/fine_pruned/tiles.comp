// Step 2: the light list of one tile, by one workgroup of 64 threads with 2x2 pixels each. Coarse: every visible light's screen bounds against
// the tile's. Fine: the coarse lights' true volumes against the tile's pixels, 64 lights at a time.
//
// Order comes from bits: a batch of lights is tested into a bit field, and a light's place in the list is the number of bits before its own.
// So it depends neither on the order of threads nor on the width of a subgroup (light_batches.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#include "light_volume.glsl"
#include "pruned_lists.h"
#include "tile_points.glsl"

layout(constant_id = 35) const bool REGIONS = false;  // the tile's region has listed the lights that it may have (regions.comp)
uint region_list;                                     // where its list begins
uint candidate(uint place);
#include "light_batches.glsl"

layout(local_size_x = ML_PRUNED_GROUP) in;
layout(constant_id = 32) const uint MODE = 0u;
const uint mode_count = 0u;   // only counts the coarse lights
const uint mode_lists = 1u;   // writes the list at the place that offsets.comp found for it
const uint mode_packed = 2u;  // the chapter's limits, and 32 bytes a list

layout(scalar, binding = 18) buffer TileLists { uvec2 tile_lists[]; };  // first light and count
layout(scalar, binding = 19) writeonly buffer ListLights { uint list_lights[]; };
layout(scalar, binding = 20) writeonly buffer PackedLists { uint packed_lists[]; };
layout(scalar, binding = 21) writeonly buffer TileCounts { uvec2 tile_counts[]; };  // lights before and after fine pruning (packed: listed_pair)
layout(scalar, binding = 22) readonly buffer RegionLists { uint region_lists[]; };
layout(scalar, push_constant) uniform Push { PrunedPush push; };

shared uint coarse[ML_PRUNED_CHUNK + batch];  // visible indices of coarse lights, in order
shared uint survivors[2];                     // which of a chunk's lights hold a pixel
const uint lists = EFFECT_PROBES ? 2u : 1u;   // of a tile: direct lights, and probe lights
shared uint kept[2u * ML_PACKED_LIGHTS];

void poison_shared() {
  poison_batches();
  for (uint i = gl_LocalInvocationIndex; i < ML_PRUNED_CHUNK + batch; i += ML_PRUNED_GROUP) coarse[i] = poison_word;
  if (gl_LocalInvocationIndex < 2u * ML_PACKED_LIGHTS) kept[gl_LocalInvocationIndex] = poison_word;
  if (gl_LocalInvocationIndex < 2u) survivors[gl_LocalInvocationIndex] = poison_word;
  barrier();
}

uint candidate(uint place) { return REGIONS ? region_lists[region_list + 1u + place] : place; }

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

// Place in the chunk at which its probe lights begin.
uint probes_from(uint begin, uint count) { return EFFECT_PROBES ? lights_before(begin, count, visible.first_probe) : count; }

void set_bit(uint at, inout uvec2 mask) {
  if (at < 32u)
    mask.x |= 1u << at;
  else
    mask.y |= 1u << (at - 32u);
}

// One loop for each type of volume. Several lights an iteration where there are many (harness/frame/shading_loops.h).
#define PRUNE(volume, end, at) \
  if (at < end && volume(points, light_at(visible_lights[coarse[begin + at]]))) set_bit(at, mask);
#define PRUNE_LOOP(volume, from, end)                                                        \
  for (uint i = from; i < end; i += LONG_LISTS ? 8u : 2u) {                                  \
    PRUNE(volume, end, i)                                                                    \
    PRUNE(volume, end, (i + 1u))                                                             \
    if (LONG_LISTS) {                                                                        \
      PRUNE(volume, end, (i + 2u)) PRUNE(volume, end, (i + 3u))                              \
      PRUNE(volume, end, (i + 4u)) PRUNE(volume, end, (i + 5u))                              \
      PRUNE(volume, end, (i + 6u)) PRUNE(volume, end, (i + 7u))                              \
    }                                                                                        \
  }

uvec2 prune_by_type(uint begin, uint count) {
  uvec2 mask = uvec2(0u);
  const uint cones = lights_before(begin, count, visible.first_cone), boxes = lights_before(begin, count, visible.first_box);
  const uint probes = probes_from(begin, count);
  if (any(points.lit)) {
    PRUNE_LOOP(in_ball, 0u, cones)
    PRUNE_LOOP(in_cone, cones, boxes)
    PRUNE_LOOP(in_box_volume, boxes, probes)
    if (EFFECT_PROBES) {
      const uint probe_cones = lights_before(begin, count, visible.first_probe_cone);
      const uint probe_boxes = lights_before(begin, count, visible.first_probe_box);
      PRUNE_LOOP(in_ball, probes, probe_cones)
      PRUNE_LOOP(in_cone, probe_cones, probe_boxes)
      PRUNE_LOOP(in_box_volume, probe_boxes, count)
    }
  }
  return mask;
}

void test_of_lane(LightCore own, LightExtra own_extra, uint lane, uint lanes, uint first, inout uvec2 mask) {
  const LightCore light = light_of_lane(own, min(lane, lanes - 1u));
  extra_at_hand = extra_of_lane(own_extra, min(lane, lanes - 1u));
  if (lane < lanes && in_volume(points, light)) set_bit(first + lane, mask);
}

// For small subgroups, each lane of which fetches a light and hands it to the others; all of them stay together. One loop for all types: where a
// loop that has nothing to do costs a turn (Mesa's software driver), three are more than one that tests for each type.
uvec2 prune_together(uint begin, uint count) {
  uvec2 mask = uvec2(0u);
  if (!any_of_all(any(points.lit))) return mask;
  for (uint first = 0u; first < count; first += SUBGROUP_LANES) {
    const LightCore own = light_at(visible_lights[coarse[begin + min(first + gl_SubgroupInvocationID, count - 1u)]]);
    LightExtra own_extra;
    if (any_extras) own_extra = extra_ahead(own);
    const uint lanes = min(count - first, SUBGROUP_LANES);
    uint lane = 0u;
    do {
      test_of_lane(own, own_extra, lane, lanes, first, mask);
      test_of_lane(own, own_extra, lane + 1u, lanes, first, mask);
      if (LONG_LISTS) {
        test_of_lane(own, own_extra, lane + 2u, lanes, first, mask);
        test_of_lane(own, own_extra, lane + 3u, lanes, first, mask);
        test_of_lane(own, own_extra, lane + 4u, lanes, first, mask);
        test_of_lane(own, own_extra, lane + 5u, lanes, first, mask);
        test_of_lane(own, own_extra, lane + 6u, lanes, first, mask);
        test_of_lane(own, own_extra, lane + 7u, lanes, first, mask);
      }
      lane += LONG_LISTS ? 8u : 2u;
    } while (lane < lanes);
  }
  return mask;
}

// Which of the coarse lights begin .. begin + count, at most 64, hold a pixel of the tile. The coarse list was written before a barrier that
// all threads have passed.
uvec2 prune(uint begin, uint count) {
  if (PRUNE == ML_PRUNE_COARSE) return uvec2(count < 32u ? (1u << count) - 1u : 0xffffffffu,
                          count < 32u ? 0u : count < 64u ? (1u << (count - 32u)) - 1u : 0xffffffffu);
  if (gl_LocalInvocationIndex < 2u) survivors[gl_LocalInvocationIndex] = 0u;
  barrier();
  uvec2 mask = small_subgroup ? prune_together(begin, count) : prune_by_type(begin, count);
  SET_BITS(survivors[0], mask.x)
  SET_BITS(survivors[1], mask.y)
  barrier();
  mask = uvec2(survivors[0], survivors[1]);
  barrier();
  return mask;
}

// Prunes a chunk and appends what is left to the tile's list.
void append_chunk(uint begin, uint count, uint first, inout uint listed) {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 mask = prune(begin, count);
  const uint all = bitCount(mask.x) + bitCount(mask.y);
  if (MODE == mode_packed) {  // the only chunk of its tile
    const uint probes = probes_from(begin, count), direct = probes < 64u ? bits_before(mask, probes) : all;
    if (has_bit(mask, thread)) {
      const bool probe = thread >= probes;
      const uint place = bits_before(mask, thread) - (probe ? direct : 0u);
      if (place < ML_PACKED_LIGHTS) kept[(probe ? ML_PACKED_LIGHTS : 0u) + place] = coarse[begin + thread];
    }
    listed = listed_pair(direct, all - direct);
    return;
  }
  if (has_bit(mask, thread)) list_lights[first + listed + bits_before(mask, thread)] = visible_lights[coarse[begin + thread]];
  listed += all;
}

// Appends the lights that passed to coarse[], as far as it holds them; how many they were.
uint keep_batch(uint first_light, uint count, uint field, uint held) {
  const uint thread = gl_LocalInvocationIndex, rounds = rounds_of(first_light, count);
  uint before = held;
  for (uint round = 0u; round < rounds; ++round) {
    const uvec2 mask = passed_in(field, round);
    if (MODE != mode_count && has_bit(mask, thread)) {
      const uint place = before + bits_before(mask, thread);
      if (MODE == mode_lists || place < ML_PRUNED_CHUNK) coarse[place] = candidate(first_light + round * ML_PRUNED_GROUP + thread);
    }
    before += bitCount(mask.x) + bitCount(mask.y);
  }
  return before - held;
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint tile = gl_WorkGroupID.y * push.columns + gl_WorkGroupID.x;
  if (POISON_SHARED) poison_shared();
  clear_batches();
  load_points();

  const uint first = MODE == mode_lists ? tile_lists[tile].x : 0u;
  const bool no_room = MODE == mode_lists && first == ML_PRUNED_ALL;
  // A tile of sky has an empty list.
  if (REGIONS)
    region_list = push.region_words * ((gl_WorkGroupID.y >> push.region_shift) * push.region_columns + (gl_WorkGroupID.x >> push.region_shift));
  const uint candidates = REGIONS ? region_lists[region_list] : visible.count;
  const uint count = no_room || !(tile_bounds.near <= tile_bounds.far) ? 0u : candidates;
  uint demand = 0u, held = 0u, listed = 0u, turn = 0u;
  for (uint begin = 0u; begin < count; begin += batch) {
    const uint field = turn * batch_words;
    test_batch(begin, count, field, tile_bounds);
    barrier();
    const uint more = keep_batch(begin, count, field, held);
    turn = next_turn(turn);
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
  if (thread < lists * ML_PACKED_WORDS) {
    const uint list = thread / ML_PACKED_WORDS, begin = 3u * (thread % ML_PACKED_WORDS);
    const uint stored = min(list == 0u ? listed & 0xffffu : listed >> 16, ML_PACKED_LIGHTS);
    const uint words_lights = stored > begin ? min(stored - begin, 3u) : 0u, from = list * ML_PACKED_LIGHTS + begin;
    packed_lists[tile * lists * ML_PACKED_WORDS + thread] =
        packed_word(words_lights > 0u ? kept[from] : 0u, words_lights > 1u ? kept[from + 1u] : 0u,
                    words_lights > 2u ? kept[from + 2u] : 0u, words_lights);
  }
}
