// Votes and minima across a subgroup all of whose lanes take part: never after && or || or ?: whose first part differs
// from lane to lane, for what follows is then asked of some lanes only, and what the others hold is missed.
//
// Small subgroups exchange values, log2 of their size times: Mesa's software driver (8 lanes) makes a shuffle one
// instruction, and a loop over all lanes of every vote, ballot and minimum.
#ifndef ML_SUBGROUP_EXCHANGE_GLSL
#define ML_SUBGROUP_EXCHANGE_GLSL
#include "shaders/constants.glsl"

const bool small_subgroup = SUBGROUP_LANES != 0u && SUBGROUP_LANES <= 8u;

uint subgroup_lanes() { return SUBGROUP_LANES != 0u ? SUBGROUP_LANES : gl_SubgroupSize; }

// The value of the lane whose number differs in one bit.
uint subgroup_shuffle_xor(uint value, uint bit) { return subgroupShuffle(value, gl_SubgroupInvocationID ^ bit); }

uint subgroup_min(uint value) {
  if (!small_subgroup) return subgroupMin(value);
  if (SUBGROUP_LANES > 1u) value = min(value, subgroup_shuffle_xor(value, 1u));
  if (SUBGROUP_LANES > 2u) value = min(value, subgroup_shuffle_xor(value, 2u));
  if (SUBGROUP_LANES > 4u) value = min(value, subgroup_shuffle_xor(value, 4u));
  return value;
}

uint subgroup_or(uint value) {
  if (!small_subgroup) return subgroupOr(value);
  if (SUBGROUP_LANES > 1u) value |= subgroup_shuffle_xor(value, 1u);
  if (SUBGROUP_LANES > 2u) value |= subgroup_shuffle_xor(value, 2u);
  if (SUBGROUP_LANES > 4u) value |= subgroup_shuffle_xor(value, 4u);
  return value;
}

bool subgroup_any(bool value) {
  return small_subgroup ? subgroup_or(value ? 1u : 0u) != 0u : subgroupAny(value);
}

// A bit for each of the first 32 lanes where it holds.
uint subgroup_ballot(bool value) {
  return small_subgroup ? subgroup_or(value ? 1u << gl_SubgroupInvocationID : 0u) : subgroupBallot(value).x;
}

#endif
