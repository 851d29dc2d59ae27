// Placement `stage`: the lights of a museum, in each of the scene's rooms as many as in any other (+-1).
//
// Lights 0 to 7 are wide spots, 8 to 13 fill points; of the others one in 20 is a capsule, one in 20 a wedge,
// one in 40 a box, and the rest are spots: 0.7 m below the ceiling, tilted 25 to 65 degrees from straight
// down, range 8 to 20 m, half-angle 14 to 30 degrees.
#pragma once

#include <cstdint>

#include "harness/lights/placement.h"

namespace ml {

inline constexpr uint32_t kWideSpots = 8, kFillPoints = 6;
inline constexpr float kShortestStageRange = 8;  // m

// The scene's rooms, or UsageError when it has none, naming the placement.
const std::vector<Bounds>& rooms_of(const Scene& scene, Placement placement);

// Light `light` of the seed; its intensity is the factor on what its radius would give it.
Light stage_light(const std::vector<Bounds>& rooms, uint32_t seed_hash, uint32_t light);

}  // namespace ml
