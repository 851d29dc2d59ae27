#include "harness/measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "harness/base/random.h"

namespace ml {

namespace {

using Laps = std::vector<std::vector<double>>;  // [repeat][frame]

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int draws = 1000;

void keep_finite(std::span<const double> samples, std::vector<double>& out) {
  out.clear();
  for (double sample : samples) {
    if (std::isfinite(sample)) out.push_back(sample);
  }
}

// Median of `samples`, which are finite and come back in another order.
double median_in_place(std::vector<double>& samples) {
  if (samples.empty()) return nan;
  auto middle = samples.begin() + static_cast<ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  // Halves are added so that two huge samples do not overflow.
  return 0.5 * *std::max_element(samples.begin(), middle) + 0.5 * *middle;
}

// The tail that a percentile interval must cut at each end for 95 % coverage with `laps` laps: plain 2.5 % is
// too narrow for few laps. Phi(-t * sqrt(n / (n-1))) with Student's t of n - 1 degrees; T. Hesterberg, "What
// Teachers Should Know About the Bootstrap", 2015, section 3.3.
double tail(size_t laps) {
  static constexpr double tails[] = {0,       0,       0.000119, 0.000954, 0.00243, 0.00411,
                                     0.00574, 0.00722, 0.00855,  0.00972,  0.0108,  0.0117,
                                     0.0125,  0.0132,  0.0139,   0.0144,   0.0150};
  constexpr size_t table_end = 2 + std::size(tails);
  if (laps < table_end) return laps < 2 ? 0 : tails[laps - 2];
  return 0.025 * (1 - 7.5 / static_cast<double>(laps));  // within 2 % of the formula from 19 laps on
}

// Frame `frame` of the laps that `picks` names, or of every lap when it is empty.
double frame_median(const Laps& laps, const std::vector<uint32_t>& picks, size_t frame,
                    std::vector<double>& scratch) {
  scratch.clear();
  auto take = [&](const std::vector<double>& lap) {
    if (frame < lap.size() && std::isfinite(lap[frame])) scratch.push_back(lap[frame]);
  };
  if (picks.empty()) {
    for (const std::vector<double>& lap : laps) take(lap);
  } else {
    for (uint32_t pick : picks) take(laps[pick]);
  }
  return median_in_place(scratch);
}

size_t frame_count(const Laps& laps) {
  size_t frames = 0;
  for (const std::vector<double>& lap : laps) frames = std::max(frames, lap.size());
  return frames;
}

void resample(std::vector<uint32_t>& picks, size_t laps, Random& random) {
  picks.resize(laps);
  for (uint32_t& pick : picks) pick = random.below(static_cast<uint32_t>(laps));
}

// `value_of` gives the value of the laps that are picked, of all when none are.
template <typename ValueOf>
Interval interval_of(size_t laps, uint32_t seed, ValueOf&& value_of) {
  std::vector<uint32_t> picks;
  const double value = value_of(picks);
  if (!std::isfinite(value)) return {nan, nan, nan, laps};
  Interval interval{value, value, value, laps};
  if (!interval.is_95()) {
    for (uint32_t lap = 0; lap < laps && laps > 1; ++lap) {
      picks = {lap};
      const double one = value_of(picks);
      if (!std::isfinite(one)) continue;
      interval.low = std::min(interval.low, one);
      interval.high = std::max(interval.high, one);
    }
    return interval;
  }
  Random random(seed);
  std::vector<double> values(draws);
  for (double& resampled : values) {
    resample(picks, laps, random);
    resampled = value_of(picks);
  }
  const double cut = tail(laps);
  interval.low = std::min(value, quantile(values, cut));
  interval.high = std::max(value, quantile(values, 1 - cut));
  return interval;
}

}  // namespace

double median(std::span<const double> samples) {
  std::vector<double> kept;
  keep_finite(samples, kept);
  return median_in_place(kept);
}

double quantile(std::span<const double> samples, double p) {
  std::vector<double> kept;
  keep_finite(samples, kept);
  if (kept.empty() || std::isnan(p)) return nan;
  std::sort(kept.begin(), kept.end());
  double rank = std::clamp(p, 0.0, 1.0) * static_cast<double>(kept.size() - 1);
  auto below = static_cast<size_t>(rank);
  double part = rank - static_cast<double>(below);
  if (part == 0) return kept[below];
  double low = kept[below], high = kept[below + 1];
  return std::clamp(low * (1 - part) + high * part, low, high);
}

Interval median_time(const Laps& samples, uint32_t seed) {
  std::vector<double> scratch;
  return interval_of(samples.size(), seed, [&](const std::vector<uint32_t>& picks) {
    scratch.clear();
    const size_t laps = picks.empty() ? samples.size() : picks.size();
    for (size_t i = 0; i < laps; ++i)
      for (double sample : samples[picks.empty() ? i : picks[i]])
        if (std::isfinite(sample)) scratch.push_back(sample);
    return median_in_place(scratch);
  });
}

Interval mean_frame_time(const Laps& samples, uint32_t seed) {
  const size_t frames = frame_count(samples);
  std::vector<double> scratch;
  return interval_of(samples.size(), seed, [&](const std::vector<uint32_t>& picks) {
    double sum = 0;
    size_t counted = 0;
    for (size_t frame = 0; frame < frames; ++frame) {
      double middle = frame_median(samples, picks, frame, scratch);
      if (std::isfinite(middle)) sum += middle, ++counted;
    }
    return counted == 0 ? nan : sum / static_cast<double>(counted);
  });
}

Interval paired_ratio(const Laps& a, const Laps& b, uint32_t seed) {
  const size_t frames = std::min(frame_count(a), frame_count(b)), laps = std::min(a.size(), b.size());
  // Laps that were not interleaved are picked apart.
  Random apart(hash_u32(seed, 1));
  std::vector<uint32_t> picks_a, picks_b;
  std::vector<double> scratch, ratios;
  return interval_of(laps, seed, [&](const std::vector<uint32_t>& picks) {
    picks_a = picks_b = picks;
    if (picks.size() > 1 && a.size() != b.size()) {
      resample(picks_a, a.size(), apart);
      resample(picks_b, b.size(), apart);
    }
    ratios.clear();
    for (size_t frame = 0; frame < frames; ++frame) {
      double top = frame_median(a, picks_a, frame, scratch),
             bottom = frame_median(b, picks_b, frame, scratch);
      if (!(top > 0 && bottom > 0)) continue;
      if (double quotient = top / bottom; std::isfinite(quotient)) ratios.push_back(quotient);
    }
    return median_in_place(ratios);
  });
}

}  // namespace ml
