// Which shading loop a frame may run on a driver that ends loops.
//
// Mesa's software driver ends all loops of a shader, in silence, after 65,535 iterations that its lanes take
// together: one that waits for another counts too (gpu::DeviceLimits::loop_iterations). A loop that is cut
// off loses lights. The functions below are upper bounds of what the loops of shaders/shade.comp and
// shade_together.glsl take, whatever the lanes of a subgroup do; a loop runs where its bound is within the
// limit, and not where it usually gets through.
#pragma once

#include <cstdint>

#include "algorithms/algorithm.h"

namespace ml {

// How a shading program walks (its specialization constants WALK_TOGETHER and LONG_LISTS).
struct ShadingLoop {
  bool together = false;    // the pixels of a subgroup walk their cells' lights together
  bool long_walks = false;  // several lights an iteration, in one loop
  auto operator<=>(const ShadingLoop&) const = default;
};

// Iterations that a subgroup of `lanes` takes at most where no pixel looks at more than `walk`.
uint64_t max_iterations(ShadingLoop loop, const LongestWalk& walk, uint32_t lanes, bool test_ahead);

// The fastest loop that is sure to end by itself. `limit`: iterations that the driver allows, 0: any number.
// Where none is sure to, the one that gets farthest: what it may lose the counting lap tells (counter
// `lost`).
ShadingLoop choose_shading_loop(const LongestWalk& walk, uint32_t lanes, bool together, bool test_ahead,
                                uint64_t limit);

// Lights that passes over all lights (shaders/contributing_*.comp, algorithms/fine_pruned) may see before
// they take several an iteration (LONG_LISTS).
constexpr uint32_t max_lights_of_short_passes = 28000;
// Lights that one dispatch of contributing_pixels.comp or of brute_force looks at at most; more take several
// dispatches.
constexpr uint32_t max_lights_of_dispatch = 262144;
// Lights of a dispatch of an algorithm that walks ranges: as many as the loop that is fastest is sure to get
// through on a driver that allows `limit` iterations (0: any number).
uint32_t lights_of_range(uint32_t lanes, uint64_t limit);

}  // namespace ml
