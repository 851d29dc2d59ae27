// What a result must say of where it comes from: program, build, host, device, environment.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/bench/calibration.h"
#include "harness/gpu/device.h"

namespace ml {

nlohmann::json run_context(const gpu::Device& device, const Calibration& calibration);

// "3 of 8 GiB" and the like are for people; these are bytes.
uint64_t peak_memory_bytes();

}  // namespace ml
