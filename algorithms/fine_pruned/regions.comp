// Step 2(b), where many lights are in view: the lights that a square of tiles may have, so that its tiles need not look
// at all. One workgroup of 64 threads a region; the order of the visible lights is kept.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#include "shaders/surface.glsl"

uint candidate(uint index) { return index; }
#include "light_batches.glsl"

layout(local_size_x = ML_PRUNED_GROUP) in;
layout(scalar, binding = 22) writeonly buffer RegionLists { uint region_lists[]; };
layout(scalar, push_constant) uniform Push { PrunedPush push; };

// Rectangle and depths of the region's pixels that are not sky.
ScreenBounds region_bounds() {
  const uint thread = gl_LocalInvocationIndex, side = ML_PRUNED_TILE << push.region_shift;
  const uvec2 corner = gl_WorkGroupID.xy * side, edge = min(corner + side - 1u, view.resolution - 1u);
  clear_depths();
  barrier();
  uint low = 0xffffffffu, high = 0u;
  for (uint y = corner.y + (thread >> 3); y <= edge.y; y += 8u)
    for (uint x = corner.x + (thread & 7u); x <= edge.x; x += 8u) {
      const float reversed = texelFetch(Depth, ivec2(x, y), 0).x;
      const uint bits = floatBitsToUint(max(depth_from_reversed(reversed), 0.0));
      low = reversed > 0.0 ? min(low, bits) : low;
      high = reversed > 0.0 ? max(high, bits) : high;
    }
  add_depths(low, high);
  barrier();
  return ScreenBounds(corner.x | edge.x << 16, corner.y | edge.y << 16, uintBitsToFloat(depth_low),
                      uintBitsToFloat(depth_high));
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint list = push.region_words * (gl_WorkGroupID.y * push.region_columns + gl_WorkGroupID.x);
  if (POISON_SHARED) {
    poison_batches();
    barrier();
  }
  clear_batches();
  const ScreenBounds region = region_bounds();
  const uint count = region.near <= region.far ? visible.count : 0u;  // else all is sky
  uint held = 0u, slot = 0u;
  for (uint begin = 0u; begin < count; begin += batch) {
    const uint field = slot * batch_words;
    test_batch(begin, count, field, region);
    barrier();
    const uint rounds = rounds_of(begin, count);
    for (uint round = 0u; round < rounds; ++round) {
      const uvec2 mask = passed_in(field, round);
      if (has_bit(mask, thread))
        region_lists[list + 1u + held + bits_before(mask, thread)] = begin + round * ML_PRUNED_GROUP + thread;
      held += bitCount(mask.x) + bitCount(mask.y);
    }
    slot = next_slot(slot);
  }
  if (thread == 0u) region_lists[list] = held;
}
