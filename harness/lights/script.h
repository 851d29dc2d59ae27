// What one light does over time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/lights/set.h"

namespace ml {

// Seconds of frame `frame` on a path of `frames` frames; a camera that stands still (duration 0) runs at 60
// frames a second.
double script_time(uint32_t frame, uint32_t frames, double duration);

// The lights of `base` as they are at `seconds`, in their order, without those that do not shine then. Light
// i of `base` is number i of `seed`. `out` and `identity` are overwritten: identity[k] is the index of out[k]
// in `base`; may be null. Nothing is allocated once they have the capacity of `base`.
void run_script(LightScript script, uint32_t seed, double seconds, std::span<const Light> base,
                std::vector<Light>& out, std::vector<uint32_t>* identity);

}  // namespace ml
