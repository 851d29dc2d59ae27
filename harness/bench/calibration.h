// Whether the device's clock can be believed: passes of known cost in four orders, timed as spans, as a whole
// and by the fence.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/gpu/commands.h"

namespace ml {

struct Calibration {
  struct Order {
    std::string passes;            // "raster, compute, raster"
    std::vector<double> spans_ms;  // one a pass
    double whole_ms = 0, fence_ms = 0;
  };
  std::vector<Order> orders;
  // The same compute pass in all orders (the fastest of its repeats each), slowest over fastest.
  double compute_spread = 0;
  // Largest |sum of spans - whole| / whole over the orders.
  double span_disagreement = 0;
  // Largest whole / fence over the orders: more than 1 would be a clock that runs ahead.
  double whole_over_fence = 0;
  bool agrees = false;  // all three within the limits below
  std::string note;     // why not; empty when it agrees

  nlohmann::json to_json() const;
};

// Limits of agreement. Noise of a shared machine is far below the error that they are for: a stamp that is
// wrong after a raster pass is wrong by a factor of hundreds.
inline constexpr double calibration_spread_limit = 2.0;
inline constexpr double calibration_span_limit = 0.10;
inline constexpr double calibration_fence_limit = 1.10;

// Takes about half a second. `repeats` per order.
Calibration calibrate(gpu::Device& device, uint32_t repeats = 5);

// Whether the three times of one submission contradict each other; "" or why. Differences below 0.2 ms are
// nothing.
std::string timing_contradiction(const gpu::SubmissionTimes& times, gpu::Timing timing);

}  // namespace ml
