// What the threads of a workgroup find together, in shared memory: the bounds of their depths, and bits. A subgroup
// makes one of its values first, so that one of its threads changes the shared word, and not each of them.
#ifndef ML_FINE_PRUNED_GROUP_VOTES_GLSL
#define ML_FINE_PRUNED_GROUP_VOTES_GLSL
#include "shaders/subgroup_exchange.glsl"

// In a flow that all threads of the workgroup take, as add_depths().
#define SET_BITS(word, bits)                                                 \
  {                                                                          \
    const uint of_subgroup = subgroup_or(bits);                              \
    if (subgroup_elect() && of_subgroup != 0u) atomicOr(word, of_subgroup); \
  }

shared uint depth_low, depth_high;  // bits of depths, which are positive and so in order

bool subgroup_elect() { return small_subgroup ? gl_SubgroupInvocationID == 0u : subgroupElect(); }

// Before the first add_depths(), and a barrier between.
void clear_depths() {
  if (gl_LocalInvocationIndex != 0u) return;
  depth_low = 0xffffffffu;
  depth_high = 0u;
}

void add_depths(uint low, uint high) {
  low = subgroup_min(low);
  high = ~subgroup_min(~high);
  if (!subgroup_elect()) return;
  atomicMin(depth_low, low);
  atomicMax(depth_high, high);
}

#endif
