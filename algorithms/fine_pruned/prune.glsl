// The fine test (step 2(d)) of up to 64 coarse lights of a tile, against every pixel of it. Before it comes what
// tiles.comp shares: coarse[] and survivors[].
#ifndef ML_PRUNE_GLSL
#define ML_PRUNE_GLSL
#include "shaders/loop_iterations.glsl"

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

// Index in the chunk of its first probe light.
uint probes_from(uint begin, uint count) {
  return EFFECT_PROBES ? lights_before(begin, count, visible.first_probe) : count;
}

void set_bit(uint at, inout uvec2 mask) {
  if (at < 32u)
    mask.x |= 1u << at;
  else
    mask.y |= 1u << (at - 32u);
}

// One loop for each type of volume.
#define PRUNE(volume, end, at) \
  if (at < end && volume(points, light_at(visible_lights[coarse[begin + at]]))) set_bit(at, mask);
#define PRUNE_BALL(n) PRUNE(in_ball, end, (i + n))
#define PRUNE_CONE(n) PRUNE(in_cone, end, (i + n))
#define PRUNE_BOX(n) PRUNE(in_box_volume, end, (i + n))
#define PRUNE_LOOP(step, from, to)                                       \
  {                                                                      \
    const uint end = to;                                                 \
    for (uint i = from; i < end; i += STRIDE_OF(2u)) { STEPS_OF_2(step) } \
  }

uvec2 prune_by_type(uint begin, uint count) {
  uvec2 mask = uvec2(0u);
  const uint cones = lights_before(begin, count, visible.first_cone),
             boxes = lights_before(begin, count, visible.first_box);
  const uint probes = probes_from(begin, count);
  if (any(points.lit)) {
    PRUNE_LOOP(PRUNE_BALL, 0u, cones)
    PRUNE_LOOP(PRUNE_CONE, cones, boxes)
    PRUNE_LOOP(PRUNE_BOX, boxes, probes)
    if (EFFECT_PROBES) {
      const uint probe_cones = lights_before(begin, count, visible.first_probe_cone);
      const uint probe_boxes = lights_before(begin, count, visible.first_probe_box);
      PRUNE_LOOP(PRUNE_BALL, probes, probe_cones)
      PRUNE_LOOP(PRUNE_CONE, probe_cones, probe_boxes)
      PRUNE_LOOP(PRUNE_BOX, probe_boxes, count)
    }
  }
  return mask;
}

void test_of_lane(LightCore own, LightExtra own_extra, uint lane, uint lanes, uint first, inout uvec2 mask) {
  const LightCore light = broadcast_light(own, min(lane, lanes - 1u));
  extra_at_hand = broadcast_extra(own_extra, min(lane, lanes - 1u));
  if (lane < lanes && in_volume(points, light)) set_bit(first + lane, mask);
}

// For small subgroups, each lane of which fetches a light and hands it to the others; all of them stay together. One
// loop for all types: where a loop that has nothing to do costs an iteration (Mesa's software driver), three are more
// than one that tests for each type.
uvec2 prune_together(uint begin, uint count) {
  uvec2 mask = uvec2(0u);
  if (!subgroup_any(any(points.lit))) return mask;
  for (uint first = 0u; first < count; first += SUBGROUP_LANES) {
    const LightCore own = light_at(visible_lights[coarse[begin + min(first + gl_SubgroupInvocationID, count - 1u)]]);
    LightExtra own_extra;
    if (any_extras) own_extra = extra_ahead(own);
    const uint lanes = min(count - first, SUBGROUP_LANES);
    uint lane = 0u;
#define TEST_OF_LANE(n) test_of_lane(own, own_extra, lane + n, lanes, first, mask);
    do {
      STEPS_OF_2(TEST_OF_LANE)
      lane += STRIDE_OF(2u);
    } while (lane < lanes);
#undef TEST_OF_LANE
  }
  return mask;
}

// Which of the coarse lights begin .. begin + count, at most 64, hold a pixel of the tile. The coarse list was written
// before a barrier that all threads have passed.
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

#endif
