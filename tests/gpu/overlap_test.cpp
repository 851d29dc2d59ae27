// When an overlap is claimed.
#include "harness/bench/overlap.h"

#include <gtest/gtest.h>

#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class OverlapClaims : public DeviceTest {};

// A frame in which lists and shadow maps ran together for so long.
gpu::SubmissionTimes together(double ms) {
  gpu::SubmissionTimes times;
  times.forked = true;
  times.intervals = {{"lists", true, 0, 3}, {"shadow_maps", false, 3 - ms, 5}};
  times.both_queues = ms;
  return times;
}

OverlapResult measured(const std::vector<double>& samples) {
  OverlapResult overlap;
  overlap.list_queue = "compute";
  overlap.ms = SampleTable(1, static_cast<uint32_t>(samples.size()));
  for (uint32_t i = 0; i < samples.size(); ++i) add_overlap(overlap, together(samples[i]), 0, i);
  settle_overlap(overlap, 1);
  return overlap;
}

TEST_F(OverlapClaims, AnOverlapIsOneThatMostSamplesShow) {
  for (const std::vector<double>& samples : {std::vector<double>{0.2, 1, 0}, {0.1}, {2, 2}}) {
    const OverlapResult overlap = measured(samples);
    EXPECT_TRUE(overlap.overlapped);
    EXPECT_EQ(overlap.note, "");
    EXPECT_EQ(overlap.ms.all("both"), samples);
  }
  for (const std::vector<double>& samples : {std::vector<double>{0}, {0, 0, 1}, {}}) {
    const OverlapResult overlap = measured(samples);
    EXPECT_FALSE(overlap.overlapped);
    EXPECT_NE(overlap.note, "");
  }
}

TEST_F(OverlapClaims, ALaterLapMayShowIt) {
  OverlapResult overlap;
  overlap.ms = SampleTable(2, 1);
  add_overlap(overlap, together(0), 0, 0);
  settle_overlap(overlap, 1);
  EXPECT_FALSE(overlap.overlapped);
  add_overlap(overlap, together(1), 1, 0);
  settle_overlap(overlap, 2);
  EXPECT_TRUE(overlap.overlapped);
  EXPECT_EQ(overlap.note, "");
}

TEST_F(OverlapClaims, WhatStandsAgainstItIsSaidAndStays) {
  const AlgorithmInfo& pruned = find_algorithm("fine_pruned", "test").info;
  const AlgorithmInfo& clustered = find_algorithm("clustered", "test").info;
  ShadingSpec shading;
  MeasureSpec measure;
  auto note = [&](const AlgorithmInfo& algorithm) {
    OverlapResult overlap = expected_overlap(device(), shading, algorithm, measure, 1);
    const std::string before = overlap.note;
    if (before.empty()) return before;
    add_overlap(overlap, together(1), 0, 0);
    settle_overlap(overlap, 1);
    EXPECT_FALSE(overlap.overlapped) << before;
    EXPECT_EQ(overlap.note, before);
    return before;
  };
  EXPECT_NE(note(pruned).find("is graphics"), std::string::npos);
  shading.list_queue = ListQueue::compute;
  EXPECT_NE(note(clustered).find("no lists"), std::string::npos);
  const bool one = device().info().second_queue == gpu::SecondQueue::none;
  EXPECT_NE(note(pruned).find(one ? "one queue" : "shadow_maps is 0"), std::string::npos);
  shading.shadow_maps = 2;
  measure.mode = TimingMode::whole;
  EXPECT_NE(note(pruned).find(one ? "one queue" : "measure.mode is whole"), std::string::npos);
}

}  // namespace
}  // namespace ml::test
