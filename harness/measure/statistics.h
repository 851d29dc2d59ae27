// Summaries of raw samples: medians, and intervals by resampling. No verdict is made from means.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ml {

// Samples that are NaN or infinite are left out everywhere.

// Middle value (mean of the two middle ones); NaN for no samples.
double median(std::span<const double> samples);
// p in [0, 1] (clamped), linear between neighbours; NaN for no samples.
double quantile(std::span<const double> samples, double p);

// From so many repeats on an interval is one of 95 %. With fewer, resampling reaches no such claim: three
// laps cover the truth in three of four cases at best.
inline constexpr size_t min_repeats_for_95 = 5;

// low <= value <= high, or all three NaN when nothing can be said. With one repeat all three are the value:
// one lap tells nothing about its own spread.
struct Interval {
  double value = 0, low = 0, high = 0;
  size_t repeats = 0;
  // Else `low` and `high` are the least and the largest of the single repeats.
  bool is_95() const { return repeats >= min_repeats_for_95; }
};

// Median over all repeats and frames; the interval as below. `samples` is [repeat][frame].
Interval median_time(const std::vector<std::vector<double>>& samples, uint32_t seed = 1);

// Per-frame time over repeats: for each frame the median over its repeats, then the mean over frames; the 95
// % interval resamples the repeats (seeded, 1000 draws), widened for few repeats; below five repeats it is
// their range. `samples` is [repeat][frame].
Interval mean_frame_time(const std::vector<std::vector<double>>& samples, uint32_t seed = 1);

// Ratio a / b: for each frame the ratio of its medians over the repeats, then the median over frames (so that
// ratio(b, a) is 1 / ratio(a, b) for an odd number of frames); frames in which a or b has no sample above 0
// are left out. The interval resamples the laps: the same laps of a and b when both have as many,
// because interleaved laps share their drift, else each on its own. `a` and `b` are [repeat][frame]; frames
// beyond the shorter one are left out.
Interval paired_ratio(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                      uint32_t seed = 1);

}  // namespace ml
