// The bounds of the shading loops' iterations against lanes in lockstep, played through on the CPU.
#include "harness/frame/shading_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "harness/base/random.h"

namespace ml {
namespace {

// Which calls of light_next() find a light that contributes, for each lane of a subgroup.
using Lanes = std::vector<std::vector<bool>>;

// The loop for short walks of shaders/shade.comp (SHADE_LOOP): all lanes look for their next light, then all
// shade.
uint64_t play_alone(const Lanes& lanes) {
  std::vector<size_t> next(lanes.size(), 0);
  std::vector<bool> done(lanes.size(), false);
  uint64_t iterations = 0;
  while (std::ranges::find(done, false) != done.end()) {
    ++iterations;
    std::vector<bool> looks(lanes.size());
    for (size_t i = 0; i < lanes.size(); ++i) looks[i] = !done[i];
    while (std::ranges::find(looks, true) != looks.end()) {
      ++iterations;
      for (size_t i = 0; i < lanes.size(); ++i) {
        if (!looks[i]) continue;
        if (next[i] == lanes[i].size()) {
          looks[i] = false;
          done[i] = true;
        } else if (lanes[i][next[i]++]) {
          looks[i] = false;
        }
      }
    }
  }
  return iterations;
}

// shade_runs() of shaders/shade_together.glsl over one cell: runs of so many lights, each light found by all
// lanes.
uint64_t play_together(const std::vector<uint64_t>& runs, uint32_t lanes, bool test_ahead) {
  uint64_t iterations = 0;
  for (uint64_t run : runs)
    for (uint64_t left = run; left > 0;) {
      const uint64_t batch = std::min<uint64_t>(left, lanes);
      left -= batch;
      iterations += 2 + (test_ahead ? 1 : 0);  // the loops over batches
      iterations += (batch + 3) / 4;           // four tests an iteration
      iterations += batch;                     // a light an iteration
    }
  return iterations;
}

TEST(ShadingLoops, LanesThatLookForLightsAloneStayWithinTheBound) {
  Random random(7);
  for (uint32_t round = 0; round < 200; ++round) {
    const uint32_t count = 1 + random.below(32), length = random.below(300), rate = 1 + random.below(40);
    Lanes lanes(count);
    for (auto& lane : lanes)
      for (uint32_t i = 0; i < length; ++i) lane.push_back(random.below(rate) == 0);
    EXPECT_LE(play_alone(lanes), max_iterations({false, false}, {length, 0}, count, false));
  }
}

// Each lane has its lights where no other has any: while one looks at them the others wait. Two iterations a
// light, as if lanes did not wait for each other, are far from enough.
TEST(ShadingLoops, LanesThatWaitForEachOtherTakeTimesAsManyIterations) {
  constexpr uint32_t count = 8, length = 4096;
  Lanes lanes(count, std::vector<bool>(length, false));
  for (uint32_t lane = 0; lane < count; ++lane)
    for (uint32_t i = lane * length / count; i < (lane + 1) * length / count; ++i) lanes[lane][i] = true;
  const uint64_t taken = play_alone(lanes);
  EXPECT_GT(taken, uint64_t{2} * length);
  EXPECT_LE(taken, max_iterations({false, false}, {length, 0}, count, false));
}

TEST(ShadingLoops, RunsWalkedTogetherStayWithinTheBound) {
  Random random(8);
  for (uint32_t round = 0; round < 500; ++round) {
    const uint32_t lanes = 1u << random.below(6);
    const bool ahead = random.below(2) == 0;
    std::vector<uint64_t> runs(1 + random.below(50));
    uint64_t lights = 0;
    for (uint64_t& run : runs) lights += run = random.below(40);
    const LongestWalk walk{lights, runs.size() == 1 ? 0 : 2 * runs.size()};
    EXPECT_LE(lanes * play_together(runs, lanes, ahead), max_iterations({true, false}, walk, lanes, ahead));
  }
}

// masked_runs() of algorithms/trees/masked_walk.glsl over a full tree of 2^height leaves all of which are
// hit, with the loop that asks for the next ones.
uint64_t play_masked(uint32_t height, uint32_t lanes) {
  const uint64_t fetches = (8 + std::min(lanes, 8u) - 1) / std::min(lanes, 8u);
  // An if is taken through by all lanes, its loop once.
  if (height > 6) return 1 + 2 * fetches + 1 + 2 * play_masked(height - 1, lanes);
  const uint64_t upper = height > 3 ? uint64_t{1} << (height - 3) : 1;
  return 1 + fetches + upper * (1 + fetches) + (height == 6 ? 2 : 1);
}

TEST(ShadingLoops, MergedLeavesStayWithinTheBound) {
  for (uint32_t height = 0; height <= 11; ++height)
    for (uint32_t lanes : {1u, 2u, 4u, 8u, 16u, 32u}) {
      const uint64_t leaves = uint64_t{1} << height, nodes = 2 * leaves;
      const LongestWalk walk{leaves, nodes, nodes / 128 + 1};
      // Every leaf is a run of one light, or all are one run.
      for (const std::vector<uint64_t>& runs :
           {std::vector<uint64_t>(leaves, 1), std::vector<uint64_t>{leaves}})
        EXPECT_LE(lanes * (play_together(runs, lanes, true) + play_masked(height, lanes)),
                  max_iterations({true, false}, walk, lanes, true))
            << height << " " << lanes;
    }
}

TEST(ShadingLoops, TheLoopChosenIsSureToEndByItself) {
  constexpr uint64_t limit = 65535;
  Random random(9);
  for (uint32_t round = 0; round < 2000; ++round) {
    const LongestWalk walk{random.below(70001), random.below(2) ? random.below(8193) : 0};
    const uint32_t lanes = 1u << random.below(7);
    const bool together = random.below(2) == 0, ahead = random.below(2) == 0;
    const ShadingLoop loop = choose_shading_loop(walk, lanes, together, ahead, limit);
    EXPECT_LE(max_iterations(loop, walk, lanes, ahead), limit)
        << walk.lights << " " << walk.nodes << " " << lanes;
    const ShadingLoop free = choose_shading_loop(walk, lanes, together, ahead, 0);
    EXPECT_EQ(free, (ShadingLoop{together, false})) << "a driver without a limit has the readable loop";
  }
}

// What one dispatch of brute force looks at is sure to be looked at, with subgroups of any size, and by the
// fastest loop.
TEST(ShadingLoops, ADispatchOfBruteForceEndsByItself) {
  EXPECT_EQ(lights_of_range(32, 0), max_lights_of_dispatch);
  for (uint32_t lanes : {1u, 4u, 8u, 16u, 32u, 64u}) {
    const LongestWalk walk{lights_of_range(lanes, 65535), 0};
    EXPECT_GT(walk.lights, 1000u);
    EXPECT_EQ(choose_shading_loop(walk, lanes, false, false, 65535), (ShadingLoop{false, false}));
    EXPECT_GT(max_iterations({false, false}, {walk.lights + 1, 0}, lanes, false), 65535u);
    EXPECT_LE(max_iterations(choose_shading_loop(walk, lanes, false, false, 65535), walk, lanes, false),
              65535u);
  }
}

}  // namespace
}  // namespace ml
