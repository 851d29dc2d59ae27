#include "harness/gpu/submission_times.h"

#include <algorithm>

namespace ml::gpu {
namespace {

uint64_t mask_of(uint32_t bits) {
  return bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1;
}

class Reader {
 public:
  Reader(const StampClock& clock, std::span<const Stamp> stamps) : clock_(clock), stamps_(stamps) {}

  // Between two stamps of one queue. Masked before and after: a counter of few bits may wrap between them.
  double between(size_t from, size_t to) const {
    const uint64_t mask = mask_of(stamps_[from].part == Part::second ? clock_.second_bits : clock_.main_bits);
    return milliseconds(((stamps_[to].ticks & mask) - (stamps_[from].ticks & mask)) & mask);
  }

  // Since the first stamp, which may be of the other queue: by the bits that both have, and negative where a
  // clock that is not the same makes it so.
  double since_begin(size_t stamp) const {
    if (stamps_[stamp].part != Part::second) return between(0, stamp);
    const uint32_t bits = std::min(clock_.main_bits, clock_.second_bits);
    const uint64_t mask = mask_of(bits), half = uint64_t{1} << (bits - 1);
    const uint64_t ticks = (stamps_[stamp].ticks - stamps_[0].ticks) & mask;
    return ticks < half ? milliseconds(ticks) : -milliseconds((~ticks & mask) + 1);
  }

 private:
  double milliseconds(uint64_t ticks) const { return static_cast<double>(ticks) * clock_.period_ns * 1e-6; }
  const StampClock& clock_;
  std::span<const Stamp> stamps_;
};

}  // namespace

double SubmissionTimes::sum_of_spans() const {
  double sum = 0;
  for (const auto& [name, span] : spans)
    if (!is_inner(name)) sum += span;
  return sum;
}

SubmissionTimes times_of(const StampClock& clock, std::span<const Stamp> stamps,
                         std::span<const StampedSpan> spans) {
  SubmissionTimes times;
  if (stamps.empty()) return times;
  const Reader reader(clock, stamps);
  times.whole = reader.between(0, stamps.size() - 1);
  // The time that the second queue may have: from the last stamp before the fork to the first after it.
  double earliest = 0, latest = times.whole;
  for (size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i].part == Part::before) earliest = reader.since_begin(i);
    if (stamps[i].part == Part::after) {
      latest = reader.since_begin(i);
      break;
    }
  }
  for (const StampedSpan& span : spans) {
    const double length = reader.between(span.first, span.last);
    const double begin = reader.since_begin(span.first);
    const bool second = stamps[span.first].part == Part::second;
    if (second) times.disorder = std::max({times.disorder, earliest - begin, begin + length - latest});
    times.intervals.push_back({span.name, second, begin, begin + length});
    auto found = std::find_if(times.spans.begin(), times.spans.end(),
                              [&](const auto& sum) { return sum.first == span.name; });
    if (found == times.spans.end())
      times.spans.emplace_back(span.name, length);
    else
      found->second += length;
  }
  // Outer spans of one queue do not overlap each other, so pairs of the two queues add up.
  for (size_t i = 0; i < spans.size(); ++i) {
    if (!times.intervals[i].second_queue || is_inner(spans[i].name)) continue;
    for (size_t j = 0; j < spans.size(); ++j) {
      if (stamps[spans[j].first].part != Part::beside || is_inner(spans[j].name)) continue;
      const SubmissionTimes::Interval &a = times.intervals[i], &b = times.intervals[j];
      times.both_queues += std::max(0.0, std::min(a.end, b.end) - std::max(a.begin, b.begin));
    }
  }
  return times;
}

}  // namespace ml::gpu
