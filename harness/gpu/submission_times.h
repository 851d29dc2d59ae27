// What the stamps of one submission say. No Vulkan here.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ml::gpu {

// A span inside another one is called "outer/inner": its time is a part of the outer one's.
inline bool is_inner(std::string_view span) {
  return span.find('/') != std::string_view::npos;
}

// Times of one submission, in milliseconds.
struct SubmissionTimes {
  // In order of recording (outer ones before what is in them), sums by name; empty unless Timing::stages.
  std::vector<std::pair<std::string, double>> spans;
  // Of all spans but those inside others: nothing counts twice. What both queues did at the same time does.
  double sum_of_spans() const;
  double whole = 0;  // first to last stamp; 0 when not timed
  double fence = 0;  // CPU clock from submit to fence

  // Every span by itself, since the first stamp; empty unless Timing::stages. Those of a second queue without
  // timestamps are not there.
  struct Interval {
    std::string name;
    bool second_queue = false;
    double begin = 0, end = 0;
  };
  std::vector<Interval> intervals;

  // Of a submission that was forked (Commands::fork).
  bool forked = false;
  double both_queues = 0;  // for how long outer spans ran on both queues at the same time
  // Vulkan does not promise that stamps of two queues can be compared. By how much those of the second queue
  // stand outside the time that the semaphores leave it: 0 when both come from one clock.
  double disorder = 0;
};

// The parts of a forked submission, in the order in which they are recorded and submitted; all but `second`
// go to the main queue. What is not forked is all `before`.
enum class Part : uint8_t { before, second, beside, after };

// One stamp: ticks as read, and the part that wrote it.
struct Stamp {
  uint64_t ticks = 0;
  Part part = Part::before;
};

// A span lies between two stamps of one queue.
struct StampedSpan {
  std::string name;  // with those of the spans around it
  size_t first = 0, last = 0;
};

// The queues' timestamps: valid bits of each, and the length of a tick, which a device has one of.
struct StampClock {
  uint32_t main_bits = 64, second_bits = 64;
  double period_ns = 1;
};

// All but `fence`. `stamps` in order of recording: the first begins the submission, the last ends it.
SubmissionTimes times_of(const StampClock& clock, std::span<const Stamp> stamps,
                         std::span<const StampedSpan> spans);

}  // namespace ml::gpu
