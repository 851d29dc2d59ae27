// Time left: within a factor of two after a tenth of the work, however the phases cost in truth.
#include "harness/bench/time_left.h"

#include <gtest/gtest.h>

#include <vector>

#include "harness/base/random.h"

namespace ml {
namespace {

struct Step {
  StepKind kind;
  double expected, took;  // s
};

// A run as it comes: programs and counting of each setup, then its laps. `factors`: what each kind takes for
// each second that is expected.
std::vector<Step> run_of(uint32_t setups, uint32_t cases, uint32_t frames, uint32_t laps,
                         const double (&factors)[3], Random& random) {
  std::vector<Step> steps;
  auto add = [&](StepKind kind, double expected, double factor) {
    steps.push_back(
        {kind, expected, expected * factor * (0.7 + 0.6 * static_cast<double>(random.uniform()))});
  };
  for (uint32_t setup = 0; setup < setups; ++setup) {
    for (uint32_t i = 0; i < cases; ++i) add(StepKind::programs, 0.4, factors[0]);
    for (uint32_t i = 0; i < cases * frames; ++i) add(StepKind::counting, 0.2, factors[1]);
    for (uint32_t i = 0; i < cases * frames * laps; ++i) add(StepKind::timing, 0.05, factors[2]);
  }
  return steps;
}

// The largest factor by which the time left is wrong between a tenth of the time and nine tenths.
double worst_factor(const std::vector<Step>& steps) {
  TimeLeft time;
  double total = 0, past = 0, worst = 1;
  for (const Step& step : steps) {
    time.plan(step.kind, step.expected);
    total += step.took;
  }
  for (const Step& step : steps) {
    time.add(step.kind, step.expected, step.took);
    past += step.took;
    if (past < 0.1 * total || past > 0.9 * total) continue;
    const double ratio = time.seconds_left() / (total - past);
    worst = std::max({worst, ratio, 1 / ratio});
  }
  return worst;
}

TEST(TimeLeft, IsRightWithinTwoOnceEachKindWasSeen) {
  Random random(1);
  // Slow compilers, slow counting, fast and slow devices: each shows in the first setup.
  for (const auto& factors : {std::array{1.0, 1.0, 1.0},
                              {30.0, 1.0, 1.0},
                              {1.0, 20.0, 1.0},
                              {0.01, 0.01, 0.01},
                              {0.1, 5.0, 50.0}}) {
    const double list[3] = {factors[0], factors[1], factors[2]};
    EXPECT_LE(worst_factor(run_of(15, 4, 8, 4, list, random)), 2) << factors[0] << " " << factors[1];
  }
}

// One setup, whose counting is dearer than expected, before any lap was timed: a mean over the steps so far
// would say six times too much.
TEST(TimeLeft, DearBeginningsDoNotStandForTheRest) {
  Random random(2);
  const double factors[3] = {1, 1.7, 1};
  EXPECT_LE(worst_factor(run_of(1, 6, 16, 40, factors, random)), 2);
}

TEST(TimeLeft, ScalesWhatWasNotSeenLikeTheRest) {
  TimeLeft time;
  time.plan(StepKind::programs, 2);
  time.plan(StepKind::timing, 10);
  EXPECT_EQ(time.seconds_left(), 12);
  EXPECT_EQ(time.fraction_done(), 0);
  time.add(StepKind::programs, 1, 3);
  EXPECT_DOUBLE_EQ(time.seconds_left(), 3 + 30);
  time.add(StepKind::programs, 1, 3);
  time.add(StepKind::timing, 10, 1);
  EXPECT_EQ(time.seconds_left(), 0);
  EXPECT_EQ(time.fraction_done(), 1);
}

}  // namespace
}  // namespace ml
