// Where shadow maps look from. No Vulkan.
#pragma once

#include <vector>

#include "algorithms/algorithm.h"

namespace ml {

// Views of `count` square maps of `size` px from the lights of the largest radius, the first of equal ones;
// probe lights cast no shadow. Spots and wedges look along their cone, boxes along their direction, the
// others down, 90 degrees wide. With fewer lights than maps there are further rounds of the lights, each
// along another axis of the world; without lights the camera's position is the only one.
std::vector<gpu_data::ViewData> shadow_views(const FrameInput& frame, uint32_t count, uint32_t size);

}  // namespace ml
