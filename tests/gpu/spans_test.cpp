// Spans inside spans.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/gpu/commands.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class NestedSpans : public DeviceTest {
 protected:
  void pass(const char* name) {
    auto span = commands_.span(name);
    commands_.fill(buffer_, 1);
  }
  gpu::SubmissionTimes record(gpu::Timing timing) {
    commands_.begin(timing);
    for (int round = 0; round < 2; ++round) {
      auto span = commands_.span("shade");
      pass("trace");
      {
        auto inner = commands_.span("reuse");
        pass("trace");
      }
      commands_.fill(buffer_, 2);
    }
    pass("trace");
    return commands_.submit();
  }
  gpu::Buffer buffer_{device(), 1 << 22, gpu::MemoryKind::device, "filled"};
  gpu::Commands commands_{device()};
};

TEST_F(NestedSpans, AreAPartOfTheSpansAroundThem) {
  if (device().limits().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  const gpu::SubmissionTimes times = record(gpu::Timing::stages);
  std::vector<std::string> names;
  for (const auto& [name, ms] : times.spans) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"shade", "shade/trace", "shade/reuse", "shade/reuse/trace", "trace"}));
  ASSERT_EQ(times.intervals.size(), 9u);
  // In the order in which they began. A clock may be too coarse to tell two stamps apart.
  for (size_t i = 0; i < times.intervals.size(); ++i) {
    const auto& outer = times.intervals[i];
    EXPECT_GE(outer.end, outer.begin);
    for (size_t j = i + 1; j < times.intervals.size(); ++j) {
      const auto& other = times.intervals[j];
      SCOPED_TRACE(other.name + " and " + outer.name);
      if (other.name.starts_with(outer.name + "/") && (i < 4) == (j < 4)) {
        EXPECT_GE(other.begin, outer.begin);
        EXPECT_LE(other.end, outer.end);
      } else {
        EXPECT_GE(other.begin, outer.end);
      }
    }
  }
  EXPECT_DOUBLE_EQ(times.sum_of_spans(), times.spans[0].second + times.spans[4].second);
  EXPECT_GE(times.spans[0].second, times.spans[1].second + times.spans[2].second);
  EXPECT_GE(times.spans[2].second, times.spans[3].second);
  EXPECT_LE(times.sum_of_spans(), times.whole * (1 + 1e-9));
  EXPECT_TRUE(record(gpu::Timing::whole).spans.empty());
}

TEST_F(NestedSpans, WhatMayNotBeIsSaid) {
  commands_.begin(gpu::Timing::stages);
  EXPECT_THROW(static_cast<void>(commands_.span("a/b")), std::logic_error);
  {
    auto span = commands_.span("open");
    EXPECT_THROW(commands_.submit(), std::logic_error);
    EXPECT_THROW(commands_.fork([] {}, [] {}), std::logic_error);
  }
  commands_.fork([&] { pass("second"); }, [&] { pass("beside"); });
  commands_.submit();
  commands_.begin(gpu::Timing::whole);
  {
    auto span = commands_.span("open");
    EXPECT_THROW(commands_.fork([] {}, [] {}), std::logic_error) << "timed or not";
  }
  commands_.submit();
}

}  // namespace
}  // namespace ml::test
