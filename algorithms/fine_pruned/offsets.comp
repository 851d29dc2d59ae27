// Where each tile's list begins: running sums of the coarse counts, which no list can be longer than. One workgroup,
// each thread a run of tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "pruned_lists.h"

layout(local_size_x = 256) in;
layout(scalar, binding = 18) writeonly buffer TileLists { uvec2 tile_lists[]; };
layout(scalar, binding = 21) readonly buffer TileCounts { uvec2 tile_counts[]; };
layout(scalar, push_constant) uniform Push { PrunedPush push; };
shared uint sums[256];

// Sums that would be over the buffer's capacity stay there.
uint add(uint a, uint b) { return a + min(b, 0xffffffffu - a); }

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint run = (push.tiles + 255u) / 256u, begin = min(thread * run, push.tiles),
             end = min(begin + run, push.tiles);
  uint sum = 0u;
  for (uint tile = begin; tile < end; ++tile) sum = add(sum, tile_counts[tile].x);
  sums[thread] = sum;
  barrier();
  for (uint reach = 1u; reach < 256u; reach *= 2u) {
    const uint before = thread >= reach ? sums[thread - reach] : 0u;
    barrier();
    sums[thread] = add(sums[thread], before);
    barrier();
  }
  uint at = thread > 0u ? sums[thread - 1u] : 0u;
  for (uint tile = begin; tile < end; ++tile) {
    const uint next = add(at, tile_counts[tile].x);
    tile_lists[tile] = uvec2(next <= push.capacity ? at : ML_PRUNED_ALL, 0u);
    at = next;
  }
}
