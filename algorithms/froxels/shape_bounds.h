// Tighter bounds for lights that are no balls: spots by their cone, wedges, boxes and capsules by theirs. In
// plain scalar code for the fast path and the reference alike: such lights are few.
#pragma once

#include <array>

#include "algorithms/algorithm.h"
#include "algorithms/froxels/binning.h"

namespace ml {

// Corners of a convex body around a light's volume, camera-relative (world axes): an oriented box whose first
// four corners may be drawn together (Mikkelsen, "Fine Pruned Tiled Light Lists", section 2.4).
using HullCorners = std::array<glm::dvec3, 8>;

// False for omni lights, capsules (two balls bound them better) and cones so wide that the ball is the better
// bound.
bool hull_corners(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra, HullCorners& corners);

// Narrows a light's box and depth interval, which come from its bounding ball, to what its shape reaches.
void tighten(const BoundsConstants& constants, const gpu_data::LightCore& core,
             const gpu_data::LightExtra& extra, LightBox& box, DepthInterval& depth);

}  // namespace ml
