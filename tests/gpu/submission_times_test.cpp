// What stamps of one and of two queues are read as.
#include "harness/gpu/submission_times.h"

#include <gtest/gtest.h>

#include <map>

#include "harness/bench/calibration.h"

namespace ml::test {
namespace {

using gpu::Part;
using gpu::Stamp;
using gpu::StampClock;
using gpu::SubmissionTimes;

// A submission as its stamps, in microseconds: a tick is one.
class Recorded {
 public:
  explicit Recorded(uint64_t begin) { stamps_.push_back({begin, Part::before}); }
  Recorded& span(const char* name, Part part, uint64_t begin, uint64_t end) {
    spans_.push_back({name, stamps_.size(), stamps_.size() + 1});
    stamps_.push_back({begin, part});
    stamps_.push_back({end, part});
    return *this;
  }
  SubmissionTimes times(uint64_t end, StampClock clock = {}) {
    clock.period_ns = 1000;
    std::vector<Stamp> all = stamps_;
    all.push_back({end, all.size() > 1 ? Part::after : Part::before});
    SubmissionTimes times = gpu::times_of(clock, all, spans_);
    times.fence = times.whole;
    for (const Stamp& stamp : stamps_) times.forked |= stamp.part != Part::before;
    return times;
  }

 private:
  std::vector<Stamp> stamps_;
  std::vector<gpu::StampedSpan> spans_;
};

// Lists from 1 to 3 and 3 to 7 ms beside shadow maps from 2 to 6, and shading.
Recorded frame(uint64_t at = 0, uint64_t second_at = 0) {
  Recorded made(at);
  made.span("bounds", Part::second, second_at + 1000, second_at + 3000)
      .span("lists", Part::second, second_at + 3000, second_at + 7000)
      .span("shadow_maps", Part::beside, at + 2000, at + 6000)
      .span("shade", Part::after, at + 7000, at + 9000);
  return made;
}

TEST(SubmissionTimes, OverlapIsWhatBothQueuesDidAtTheSameTime) {
  const SubmissionTimes times = frame().times(9000);
  EXPECT_DOUBLE_EQ(times.whole, 9);
  EXPECT_DOUBLE_EQ(times.both_queues, 4);  // 1 beside bounds and 3 beside lists
  EXPECT_DOUBLE_EQ(times.disorder, 0);
  ASSERT_EQ(times.spans.size(), 4u);
  EXPECT_EQ(times.spans[2].first, "shadow_maps");
  EXPECT_DOUBLE_EQ(times.spans[2].second, 4);
  ASSERT_EQ(times.intervals.size(), 4u);
  EXPECT_TRUE(times.intervals[1].second_queue);
  EXPECT_DOUBLE_EQ(times.intervals[1].begin, 3);
  EXPECT_DOUBLE_EQ(times.intervals[1].end, 7);
  EXPECT_FALSE(times.intervals[2].second_queue);
}

TEST(SubmissionTimes, OneAfterTheOtherIsNoOverlap) {
  const SubmissionTimes times = Recorded(0)
                                    .span("lists", Part::second, 1000, 3000)
                                    .span("shadow_maps", Part::beside, 3000, 5000)
                                    .span("shade", Part::after, 5000, 6000)
                                    .times(6000);
  EXPECT_EQ(times.both_queues, 0);
  EXPECT_EQ(times.disorder, 0);
}

TEST(SubmissionTimes, CountersOfFewBitsWrapAnywhere) {
  const SubmissionTimes plain = frame().times(9000);
  // The second queue's upper bits are another counter's: those that both have are all that counts.
  for (uint32_t bits : {14u, 20u, 36u}) {
    const uint64_t wrap = uint64_t{1} << bits;
    for (uint64_t before : {uint64_t{0}, uint64_t{1}, uint64_t{999}, uint64_t{1500}, uint64_t{8999}}) {
      const uint64_t at = wrap - before, elsewhere = at + 5 * wrap;
      for (const StampClock& clock : {StampClock{64, bits}, StampClock{bits, 64}, StampClock{bits, bits}}) {
        const SubmissionTimes times = frame(at, elsewhere).times(at + 9000, clock);
        EXPECT_DOUBLE_EQ(times.whole, plain.whole) << bits << " bits, " << before;
        EXPECT_DOUBLE_EQ(times.both_queues, plain.both_queues) << bits << " bits, " << before;
        EXPECT_DOUBLE_EQ(times.disorder, 0) << bits << " bits, " << before;
      }
    }
  }
}

TEST(SubmissionTimes, AClockThatIsAnotherOneIsSeen) {
  // The second queue's stamps stand before the fork, or after the join.
  EXPECT_NEAR(frame(10'000, 7'000).times(19'000).disorder, 2, 1e-9);
  EXPECT_NEAR(frame(0, 2'500).times(9'000).disorder, 2.5, 1e-9);
  const std::string why = timing_contradiction(frame(10'000, 7'000).times(19'000), gpu::Timing::stages);
  EXPECT_NE(why.find("2.00 ms outside"), why.npos) << why;
}

TEST(TimingContradiction, CountsOnceWhatTwoQueuesDidTogether) {
  EXPECT_EQ(timing_contradiction(Recorded(0)
                                     .span("lists", Part::second, 0, 6000)
                                     .span("shadow_maps", Part::beside, 0, 5000)
                                     .span("shade", Part::after, 6000, 9000)
                                     .times(9000),
                                 gpu::Timing::stages),
            "");
  // A hole that nothing accounts for.
  EXPECT_NE(timing_contradiction(Recorded(0)
                                     .span("lists", Part::second, 0, 3000)
                                     .span("shadow_maps", Part::beside, 0, 3000)
                                     .span("shade", Part::after, 6000, 9000)
                                     .times(9000),
                                 gpu::Timing::stages),
            "");
}

TEST(TimingContradiction, CountsOnceWhatIsInsideAnotherSpan) {
  // In milliseconds: lists from 1 to 3 with a part of 1, beside shadow maps from 0 to 4 with a part of 1.5.
  const std::vector<Stamp> stamps{{0, Part::before},    {1000, Part::second}, {1500, Part::second},
                                  {2500, Part::second}, {3000, Part::second}, {0, Part::beside},
                                  {500, Part::beside},  {2000, Part::beside}, {4000, Part::beside},
                                  {4000, Part::after}};
  const std::vector<gpu::StampedSpan> spans{
      {"lists", 1, 4}, {"lists/coarse", 2, 3}, {"shadow_maps", 5, 8}, {"shadow_maps/first", 6, 7}};
  SubmissionTimes times = gpu::times_of({64, 64, 1000}, stamps, spans);
  times.forked = true;
  times.fence = times.whole;
  EXPECT_DOUBLE_EQ(times.both_queues, 2);
  EXPECT_DOUBLE_EQ(times.sum_of_spans(), 6);
  ASSERT_EQ(times.spans.size(), 4u);
  EXPECT_DOUBLE_EQ(times.spans[1].second, 1);
  EXPECT_DOUBLE_EQ(times.spans[3].second, 1.5);
  EXPECT_EQ(timing_contradiction(times, gpu::Timing::stages), "");
}

TEST(TimingContradiction, AllowsAQueueWithoutTimestampsItsTime) {
  Recorded unseen(0);
  unseen.span("shadow_maps", Part::beside, 0, 1000).span("shade", Part::after, 6000, 9000);
  EXPECT_EQ(timing_contradiction(unseen.times(9000), gpu::Timing::stages), "");
  // But not spans that are longer than the whole.
  Recorded longer(0);
  longer.span("shadow_maps", Part::beside, 0, 8000).span("shade", Part::after, 6000, 9000);
  EXPECT_NE(timing_contradiction(longer.times(9000), gpu::Timing::stages), "");
}

}  // namespace
}  // namespace ml::test
