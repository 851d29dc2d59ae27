#include "harness/bench/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/frame/calibration_passes.h"
#include "harness/measure/statistics.h"

namespace ml {
namespace {

constexpr double negligible_ms = 0.2;

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum;
}

}  // namespace

Calibration calibrate(gpu::Device& device, uint32_t repeats) {
  Calibration result;
  if (device.limits().timestamp_valid_bits == 0) {
    result.note = "the device's queue has no timestamps";
    return result;
  }
  CalibrationPasses passes(device);
  using Kind = CalibrationPasses::Kind;
  const std::vector<std::vector<Kind>> orders{{Kind::compute},
                                              {Kind::raster, Kind::compute},
                                              {Kind::compute, Kind::raster, Kind::compute},
                                              {Kind::raster, Kind::compute, Kind::raster}};
  std::vector<double> compute_times;
  for (const std::vector<Kind>& order : orders) {
    std::vector<gpu::SubmissionTimes> samples;
    passes.run(order);  // warm-up
    for (uint32_t i = 0; i < repeats; ++i) samples.push_back(passes.run(order));
    // The sample with the middle whole time stands for the order.
    std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.whole < b.whole; });
    const gpu::SubmissionTimes& middle = samples[samples.size() / 2];
    Calibration::Order entry;
    for (size_t i = 0; i < order.size(); ++i) {
      entry.passes += (i ? ", " : "") + std::string(order[i] == Kind::compute ? "compute" : "raster");
      entry.spans_ms.push_back(middle.spans[i].second);
      // The fastest of the repeats: other programs can only make a pass slower.
      double fastest = samples.front().spans[i].second;
      for (const gpu::SubmissionTimes& sample : samples) fastest = std::min(fastest, sample.spans[i].second);
      if (order[i] == Kind::compute) compute_times.push_back(fastest);
    }
    entry.whole_ms = middle.whole;
    entry.fence_ms = middle.fence;
    double whole = std::max(middle.whole, 1e-6);
    result.span_disagreement =
        std::max(result.span_disagreement, std::abs(sum_of(entry.spans_ms) - whole) / whole);
    result.whole_over_fence = std::max(result.whole_over_fence, middle.whole / std::max(middle.fence, 1e-6));
    result.orders.push_back(std::move(entry));
  }
  auto [fastest, slowest] = std::minmax_element(compute_times.begin(), compute_times.end());
  result.compute_spread = *slowest / std::max(*fastest, 1e-6);
  if (result.compute_spread > calibration_spread_limit)
    result.note = fmt::format("the same pass takes {:.2f} times as long in one order as in another",
                              result.compute_spread);
  else if (result.span_disagreement > calibration_span_limit)
    result.note = fmt::format("the spans' sum is {:.0f} % off the whole", 100 * result.span_disagreement);
  else if (result.whole_over_fence > calibration_fence_limit)
    result.note = fmt::format("the device counts {:.2f} times the time that passes", result.whole_over_fence);
  result.agrees = result.note.empty();
  return result;
}

std::string timing_contradiction(const gpu::SubmissionTimes& times, gpu::Timing timing) {
  if (timing == gpu::Timing::none) return "";
  if (times.whole > times.fence * 1.05 + negligible_ms)
    return fmt::format("stamps say {:.2f} ms, the fence {:.2f} ms", times.whole, times.fence);
  if (times.fence > times.whole * 1.5 + 5)
    return fmt::format("the fence took {:.2f} ms, stamps say {:.2f} ms", times.fence, times.whole);
  if (times.disorder > negligible_ms)
    return fmt::format("stamps of the second queue are {:.2f} ms outside the time between its semaphores",
                       times.disorder);
  if (timing == gpu::Timing::stages) {
    // What two queues did at the same time took that time once.
    const double sum = times.sum_of_spans() - times.both_queues;
    // A second queue without timestamps leaves a gap.
    const bool seen = !times.forked || std::any_of(times.intervals.begin(), times.intervals.end(),
                                                   [](const auto& span) { return span.second_queue; });
    const double off = seen ? std::abs(sum - times.whole) : std::max(0.0, sum - times.whole);
    if (off > 0.1 * times.whole + negligible_ms)
      return fmt::format("spans sum to {:.2f} ms, the whole is {:.2f} ms", sum, times.whole);
  }
  return "";
}

nlohmann::json Calibration::to_json() const {
  nlohmann::json list = nlohmann::json::array();
  for (const Order& order : orders)
    list.push_back({{"passes", order.passes},
                    {"spans_ms", order.spans_ms},
                    {"whole_ms", order.whole_ms},
                    {"fence_ms", order.fence_ms}});
  return {{"orders", list},
          {"compute_spread", compute_spread},
          {"span_disagreement", span_disagreement},
          {"whole_over_fence", whole_over_fence},
          {"agrees", agrees},
          {"note", note}};
}

}  // namespace ml
