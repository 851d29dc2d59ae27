// Step 2: the light list of one tile, by one workgroup of 64 threads with 2x2 pixels each. Coarse: every visible
// light's screen bounds against the tile's. Fine: the coarse lights' true volumes against the tile's pixels, 64 lights
// at a time.
//
// Order comes from bits: a batch of lights is tested into a bit field, and a light's rank in the list is the number of
// bits before its own. So it depends neither on the order of threads nor on the width of a subgroup
// (light_batches.glsl).
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

// The tile's region has listed the lights that it may have (regions.comp).
layout(constant_id = 35) const bool REGIONS = false;
uint region_list;                                     // where its list begins
uint candidate(uint index);
#include "light_batches.glsl"

layout(local_size_x = ML_PRUNED_GROUP) in;
layout(constant_id = 32) const uint MODE = 0u;
const uint mode_count = 0u;   // only counts the coarse lights
const uint mode_lists = 1u;   // writes the list where offsets.comp found space for it
const uint mode_packed = 2u;  // the chapter's limits, and 32 bytes a list

layout(scalar, binding = 18) buffer TileLists { uvec2 tile_lists[]; };  // first light and count
layout(scalar, binding = 19) writeonly buffer ListLights { uint list_lights[]; };
layout(scalar, binding = 20) writeonly buffer PackedLists { uint packed_lists[]; };
// Lights before and after fine pruning (packed: listed_pair).
layout(scalar, binding = 21) writeonly buffer TileCounts { uvec2 tile_counts[]; };
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

uint candidate(uint index) { return REGIONS ? region_lists[region_list + 1u + index] : index; }

#include "prune.glsl"

// Prunes a chunk and appends what is left to the tile's list.
void append_chunk(uint begin, uint count, uint first, inout uint listed) {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 mask = prune(begin, count);
  const uint all = bitCount(mask.x) + bitCount(mask.y);
  if (MODE == mode_packed) {  // the only chunk of its tile
    const uint probes = probes_from(begin, count), direct = probes < 64u ? bits_before(mask, probes) : all;
    if (has_bit(mask, thread)) {
      const bool probe = thread >= probes;
      const uint rank = bits_before(mask, thread) - (probe ? direct : 0u);
      if (rank < ML_PACKED_LIGHTS) kept[(probe ? ML_PACKED_LIGHTS : 0u) + rank] = coarse[begin + thread];
    }
    listed = listed_pair(direct, all - direct);
    return;
  }
  if (has_bit(mask, thread))
    list_lights[first + listed + bits_before(mask, thread)] = visible_lights[coarse[begin + thread]];
  listed += all;
}

// Appends the lights that passed to coarse[], as far as it holds them; how many they were.
uint keep_batch(uint first_light, uint count, uint field, uint held) {
  const uint thread = gl_LocalInvocationIndex, rounds = rounds_of(first_light, count);
  uint before = held;
  for (uint round = 0u; round < rounds; ++round) {
    const uvec2 mask = passed_in(field, round);
    if (MODE != mode_count && has_bit(mask, thread)) {
      const uint rank = before + bits_before(mask, thread);
      if (MODE == mode_lists || rank < ML_PRUNED_CHUNK)
        coarse[rank] = candidate(first_light + round * ML_PRUNED_GROUP + thread);
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
  const bool no_space = MODE == mode_lists && first == ML_PRUNED_ALL;
  // A tile of sky has an empty list.
  if (REGIONS)
    region_list = push.region_words * ((gl_WorkGroupID.y >> push.region_shift) * push.region_columns +
                                       (gl_WorkGroupID.x >> push.region_shift));
  const uint candidates = REGIONS ? region_lists[region_list] : visible.count;
  const uint count = no_space || !(tile_bounds.near <= tile_bounds.far) ? 0u : candidates;
  uint demand = 0u, held = 0u, listed = 0u, slot = 0u;
  for (uint begin = 0u; begin < count; begin += batch) {
    const uint field = slot * batch_words;
    test_batch(begin, count, field, tile_bounds);
    barrier();
    const uint more = keep_batch(begin, count, field, held);
    slot = next_slot(slot);
    demand += more;
    held += more;
    if (MODE == mode_lists && held >= ML_PRUNED_CHUNK) {
      barrier();
      uint done = 0u;
      for (; held - done >= ML_PRUNED_CHUNK; done += ML_PRUNED_CHUNK)
        append_chunk(done, ML_PRUNED_CHUNK, first, listed);
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
  if (MODE == mode_lists && no_space) listed = visible.count;
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
