#include "harness/frame/shading_loops.h"

#include <algorithm>

namespace ml {
namespace {

// What cursors take besides: copying a tree to shared memory (512 nodes), counting what is listed.
constexpr uint64_t besides = 1024;

// Calls of light_next() in an iteration of the loop for long walks, and lights that a subgroup tests or adds
// in one.
constexpr uint64_t unrolled = 8;

uint64_t divided_up(uint64_t items, uint64_t by) {
  return (items + by - 1) / by;
}

// Every call of light_next() takes a light or a node, the last one finds nothing.
uint64_t alone(const LongestWalk& walk, uint32_t lanes, bool long_walks) {
  const uint64_t calls = walk.lights + walk.nodes + 1;
  // Every lane takes a step in every iteration.
  if (long_walks) return divided_up(calls, unrolled);
  // Each iteration of the inner loop is a step of at least one lane; each of the outer one is at least a
  // light of the lane that is last.
  return lanes * calls + calls;
}

// Of masked_runs() and its caller's loop in one cell (algorithms/trees/masked_walk.glsl).
uint64_t merged(uint64_t subtrees, uint64_t lanes) {
  // Of a tree there are no more nodes above its subtrees than subtrees and levels; each is an iteration, as
  // is each subtree, and each half of its leaves one of the caller's.
  const uint64_t above = subtrees + 5;
  // Eight nodes are asked at a time: the upper ones, and the leaves below each of those. A node that is left
  // out asks once too, where a processor takes its lanes through every loop once.
  const uint64_t fetches = divided_up(8, std::min<uint64_t>(lanes, 8));
  return subtrees * (3 + fetches + 8 * (1 + fetches)) + above * (2 + 2 * fetches + 1);
}

// Of one cell. What ends a loop is the same for all lanes.
uint64_t together_in_cell(const LongestWalk& walk, uint32_t lanes, bool long_walks, bool test_ahead) {
  // At least as many nodes as there are lanes are taken by an iteration of tree_runs(), and by one of its
  // caller's loop. Half of the nodes are leaves, each a run of lights of its own; all lights of a list are
  // one run.
  const uint64_t node_batches = walk.nodes / lanes + 2, runs = (walk.nodes + 1) / 2 + 1;
  const uint64_t walked = walk.subtrees > 0 ? merged(walk.subtrees, lanes) : 2 * node_batches;
  // The last batch of a run may be short.
  const uint64_t light_batches = walk.lights / lanes + runs;
  const uint64_t tests =
      long_walks ? (lanes <= unrolled ? 0 : divided_up(lanes, unrolled)) : divided_up(lanes, 4);
  const uint64_t around = 2 + (test_ahead ? 1 : 0);  // the loops over batches themselves
  // A light is added at most once by each lane, all lanes at a time.
  const uint64_t added = long_walks ? light_batches * divided_up(lanes, unrolled) : walk.lights;
  return walked + light_batches * (around + tests) + added;
}

}  // namespace

uint64_t max_iterations(ShadingLoop loop, const LongestWalk& walk, uint32_t lanes, bool test_ahead) {
  lanes = std::clamp(lanes, 1u, 32u);  // of a subgroup that hands lights around; more are 32 at a time
  const uint64_t apart = alone(walk, lanes, loop.long_walks) + besides;
  if (!loop.together) return apart;
  const uint64_t cell = together_in_cell(walk, lanes, loop.long_walks, test_ahead);
  // With long walks a subgroup whose pixels lie in several cells goes by pixels.
  return loop.long_walks ? std::max(apart, cell + 1 + besides) : lanes * (cell + 1) + besides;
}

uint32_t lights_of_range(uint32_t lanes, uint64_t limit) {
  if (limit == 0) return max_lights_of_dispatch;
  uint32_t sure = 1, not_sure = max_lights_of_dispatch + 1;
  while (not_sure - sure > 1) {
    const uint32_t lights = sure + (not_sure - sure) / 2;
    (max_iterations({false, false}, {lights, 0}, lanes, false) <= limit ? sure : not_sure) = lights;
  }
  return sure;
}

ShadingLoop choose_shading_loop(const LongestWalk& walk, uint32_t lanes, bool together, bool test_ahead,
                                uint64_t limit) {
  for (ShadingLoop loop : {ShadingLoop{together, false}, ShadingLoop{together, true}})
    if (limit == 0 || max_iterations(loop, walk, lanes, test_ahead) <= limit) return loop;
  return {false, true};
}

}  // namespace ml
