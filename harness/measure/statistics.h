// Summaries of raw samples: medians, and intervals by resampling. No verdict is made from means.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ml {

// Middle value (mean of the two middle ones); NaN for no samples.
double median(std::span<const double> samples);
// p in [0, 1], linear between neighbours; NaN for no samples.
double quantile(std::span<const double> samples, double p);

struct Interval {
  double value = 0, low = 0, high = 0;
};

// Per-frame time over repeats: for each frame the median over its repeats, then the mean over frames; the 95 % interval resamples the
// repeats (seeded, 1000 draws). `samples` is [repeat][frame].
Interval mean_frame_time(const std::vector<std::vector<double>>& samples, uint32_t seed = 1);

// Ratio a / b paired by frame, resampled over repeats, with a 95 % interval; both are [repeat][frame] of the same shape.
Interval paired_ratio(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b, uint32_t seed = 1);

}  // namespace ml
