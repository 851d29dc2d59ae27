// A camera path for a level that brings none.
#pragma once

#include <cstdint>

#include "harness/scene/scene.h"

namespace ml {

// A path at eye height (1.7 m) above upward-facing floor, looking along long free views; seeded,
// deterministic. Levels without any floor, and those that a visitor would look past, get one around their
// bounds (orbit_path.h). Every frame sees a surface, where any can be seen from outside.
CameraPath automatic_path(const Scene& scene, uint32_t seed);

}  // namespace ml
