#include "harness/measure/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/random.h"

namespace ml {
namespace {

using Laps = std::vector<std::vector<double>>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> random_samples(Random& random, size_t count) {
  std::vector<double> samples(count);
  for (double& sample : samples) sample = random.uniform(-5, 20);
  return samples;
}

// Sum of 12 uniform numbers: near enough to normal, mean 0, deviation 1.
double noise(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

TEST(Median, SplitsSamplesInHalves) {
  Random random(1);
  for (size_t count = 1; count < 60; ++count) {
    std::vector<double> samples = random_samples(random, count);
    double middle = median(samples);
    auto below = std::count_if(samples.begin(), samples.end(), [&](double s) { return s < middle; });
    auto above = std::count_if(samples.begin(), samples.end(), [&](double s) { return s > middle; });
    EXPECT_EQ(below, above);
    EXPECT_LE(below, static_cast<ptrdiff_t>(count / 2));
    EXPECT_DOUBLE_EQ(middle, quantile(samples, 0.5));
    std::reverse(samples.begin(), samples.end());
    EXPECT_EQ(median(samples), middle);
  }
}

TEST(Median, OfNothingIsNan) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(median(std::vector<double>{nan, infinity})));
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_TRUE(std::isnan(quantile(std::vector<double>{1}, nan)));
}

TEST(Median, LeavesOutWhatIsNotFinite) {
  EXPECT_EQ(median(std::vector<double>{nan, 3, -infinity, 1, infinity, 2, nan}), 2);
  EXPECT_EQ(median(std::vector<double>{1e308, 1.5e308}), 1.25e308);
}

TEST(Quantile, IsMonotoneAndEndsAtTheExtremes) {
  Random random(2);
  for (size_t count = 1; count < 40; ++count) {
    std::vector<double> samples = random_samples(random, count);
    EXPECT_EQ(quantile(samples, 0), *std::min_element(samples.begin(), samples.end()));
    EXPECT_EQ(quantile(samples, 1), *std::max_element(samples.begin(), samples.end()));
    EXPECT_EQ(quantile(samples, -3), quantile(samples, 0));
    EXPECT_EQ(quantile(samples, 7), quantile(samples, 1));
    double before = quantile(samples, 0);
    for (int i = 1; i <= 200; ++i) {
      double now = quantile(samples, i / 200.0);
      EXPECT_LE(before, now);
      before = now;
    }
  }
}

TEST(Quantile, IsLinearBetweenNeighbours) {
  std::vector<double> samples{10, 0, 20, 30, 40};
  EXPECT_DOUBLE_EQ(quantile(samples, 0.25), 10);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.3), 12);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.9), 36);
}

TEST(MedianTime, IsTheMedianOfAllSamplesWithinItsInterval) {
  Random random(11);
  for (size_t repeats = 1; repeats < 12; ++repeats) {
    Laps laps;
    std::vector<double> all;
    for (size_t i = 0; i < repeats; ++i) {
      laps.push_back(random_samples(random, 1 + repeats % 5));
      all.insert(all.end(), laps.back().begin(), laps.back().end());
    }
    laps[0].push_back(nan);
    const Interval time = median_time(laps);
    EXPECT_DOUBLE_EQ(time.value, median(all));
    EXPECT_LE(time.low, time.value);
    EXPECT_GE(time.high, time.value);
    EXPECT_EQ(repeats == 1, time.low == time.high) << repeats;
    EXPECT_EQ(median_time(laps).low, time.low) << "the same seed";
  }
  EXPECT_TRUE(std::isnan(median_time({}).value));
  EXPECT_TRUE(std::isnan(median_time({{nan}, {}}).high));
}

TEST(MeanFrameTime, IsTheMeanOfTheFramesMedians) {
  // One outlier in a lap moves no median of three.
  Laps laps{{1, 10}, {2, 20}, {3, 9000}};
  EXPECT_DOUBLE_EQ(mean_frame_time(laps).value, (2 + 20) / 2.0);
}

TEST(MeanFrameTime, OneRepeatHasNoSpread) {
  Interval interval = mean_frame_time({{1, 2, 6}});
  EXPECT_DOUBLE_EQ(interval.value, 3);
  EXPECT_EQ(interval.low, interval.value);
  EXPECT_EQ(interval.high, interval.value);
}

TEST(MeanFrameTime, EqualSamplesHaveAnEmptyInterval) {
  for (double value : {0.0, 1.0, 16.6}) {
    Interval interval = mean_frame_time(Laps(5, std::vector<double>(7, value)));
    EXPECT_DOUBLE_EQ(interval.value, value);
    EXPECT_EQ(interval.low, interval.value);
    EXPECT_EQ(interval.high, interval.value);
  }
}

TEST(MeanFrameTime, SurvivesHoles) {
  EXPECT_TRUE(std::isnan(mean_frame_time({}).value));
  EXPECT_TRUE(std::isnan(mean_frame_time({{}, {}}).low));
  EXPECT_TRUE(std::isnan(mean_frame_time({{nan}, {nan}}).high));
  Interval holes = mean_frame_time({{1, nan, 3}, {nan, nan, 3}, {1, nan}});
  EXPECT_DOUBLE_EQ(holes.value, 2);
  EXPECT_LE(holes.low, holes.value);
  EXPECT_GE(holes.high, holes.value);
}

TEST(MeanFrameTime, SameSeedSameBits) {
  Random random(3);
  Laps laps;
  for (int lap = 0; lap < 9; ++lap) laps.push_back(random_samples(random, 11));
  Interval first = mean_frame_time(laps, 4), again = mean_frame_time(laps, 4),
           other = mean_frame_time(laps, 5);
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  EXPECT_EQ(first.value, other.value);
  EXPECT_NE(first.low, other.low);
}

TEST(MeanFrameTime, ScalesWithItsUnit) {
  Random random(6);
  Laps laps, doubled;
  for (int lap = 0; lap < 6; ++lap) {
    laps.push_back(random_samples(random, 5));
    doubled.push_back(laps.back());
    for (double& sample : doubled.back()) sample *= 2;
  }
  Interval one = mean_frame_time(laps), two = mean_frame_time(doubled);
  EXPECT_EQ(two.value, 2 * one.value);
  EXPECT_EQ(two.low, 2 * one.low);
  EXPECT_EQ(two.high, 2 * one.high);
}

// Share of 300 synthetic experiments whose interval holds the true mean frame time. Laps drift as wholes and
// frames jitter.
double coverage(size_t repeats, double lap_noise, double frame_noise) {
  constexpr int experiments = 300, frames = 6;
  Random random(repeats * 1000 + 17);
  int covered = 0;
  for (int experiment = 0; experiment < experiments; ++experiment) {
    Laps laps(repeats, std::vector<double>(frames));
    for (auto& lap : laps) {
      double drift = lap_noise * noise(random);
      for (int frame = 0; frame < frames; ++frame)
        lap[frame] = 10 + frame + drift + frame_noise * noise(random);
    }
    Interval interval = mean_frame_time(laps, static_cast<uint32_t>(experiment));
    covered += interval.low <= 12.5 && 12.5 <= interval.high;
  }
  ::testing::Test::RecordProperty("coverage_of_" + std::to_string(repeats), std::to_string(covered / 300.0));
  return covered / static_cast<double>(experiments);
}

// Binomial deviation at 95 % and 300 experiments: 1.3 %.
TEST(MeanFrameTime, IntervalsCoverTheTruth) {
  for (size_t repeats : {10, 20, 40}) {
    for (double lap_noise : {0.0, 0.5}) {
      double share = coverage(repeats, lap_noise, 1);
      EXPECT_GE(share, 0.90) << repeats << " repeats, lap noise " << lap_noise;
      EXPECT_LE(share, 1.00);
    }
  }
}

TEST(MeanFrameTime, FiveRepeatsStillCoverMostly) {
  EXPECT_GE(coverage(5, 0.5, 1), 0.85);
}

// Below five repeats no interval is claimed: least and largest of the single repeats stand there.
TEST(Intervals, OfFewRepeatsAreTheirRange) {
  Random random(21);
  for (size_t repeats = 1; repeats < 9; ++repeats) {
    Laps a, b;
    for (size_t i = 0; i < repeats; ++i) {
      a.push_back(random_samples(random, 7));
      b.push_back(random_samples(random, 7));
      for (double& sample : a.back()) sample = std::abs(sample) + 1;
      for (double& sample : b.back()) sample = std::abs(sample) + 1;
    }
    const Interval times[] = {median_time(a), mean_frame_time(a), paired_ratio(a, b)};
    for (size_t kind = 0; kind < 3; ++kind) {
      const Interval& whole = times[kind];
      EXPECT_EQ(whole.repeats, repeats);
      EXPECT_EQ(whole.is_95(), repeats >= 5);
      if (whole.is_95()) continue;
      double least = whole.value, largest = whole.value;
      for (size_t i = 0; i < repeats; ++i) {
        const Laps one{a[i]}, other{b[i]};
        const double value = kind == 0   ? median_time(one).value
                             : kind == 1 ? mean_frame_time(one).value
                                         : paired_ratio(one, other).value;
        least = std::min(least, value), largest = std::max(largest, value);
      }
      EXPECT_EQ(whole.low, least);
      EXPECT_EQ(whole.high, largest);
    }
  }
}

TEST(MeanFrameTime, MoreRepeatsNarrowTheInterval) {
  Random random(8);
  auto width = [&](size_t repeats) {
    double sum = 0;
    for (uint32_t experiment = 0; experiment < 30; ++experiment) {
      Laps laps(repeats, std::vector<double>(4));
      for (auto& lap : laps) {
        for (double& sample : lap) sample = 10 + noise(random);
      }
      Interval interval = mean_frame_time(laps, experiment);
      sum += interval.high - interval.low;
    }
    return sum;
  };
  double few = width(10), many = width(90);
  EXPECT_NEAR(few / many, 3, 0.75);  // like 1 / sqrt(repeats)
}

TEST(PairedRatio, FindsAnExactFactorWithoutSpread) {
  Random random(9);
  Laps a, b;
  for (int lap = 0; lap < 4; ++lap) {
    b.emplace_back();
    for (int frame = 0; frame < 9; ++frame) b.back().push_back(random.uniform(1, 50));
    a.push_back(b.back());
    for (double& sample : a.back()) sample *= 2;
  }
  Interval interval = paired_ratio(a, b);
  EXPECT_DOUBLE_EQ(interval.value, 2);
  EXPECT_DOUBLE_EQ(interval.low, 2);
  EXPECT_DOUBLE_EQ(interval.high, 2);
}

TEST(PairedRatio, SwapsToItsInverse) {
  Random random(10);
  Laps a(5), b(5);
  for (int lap = 0; lap < 5; ++lap) {
    for (int frame = 0; frame < 7; ++frame) {
      a[lap].push_back(random.uniform(1, 3));
      b[lap].push_back(random.uniform(1, 3));
    }
  }
  EXPECT_NEAR(paired_ratio(a, b).value * paired_ratio(b, a).value, 1, 1e-12);
}

// Drift that hits both alike must not widen the interval: the laps are paired.
TEST(PairedRatio, SharedDriftCancels) {
  Random random(11);
  Laps a(6, std::vector<double>(5)), b = a, c = a;
  for (int lap = 0; lap < 6; ++lap) {
    double drift = 1 + 0.3 * random.uniform(), other_drift = 1 + 0.3 * random.uniform();
    for (int frame = 0; frame < 5; ++frame) {
      b[lap][frame] = (5 + frame) * drift;
      a[lap][frame] = 1.5 * (5 + frame) * drift;
      c[lap][frame] = 1.5 * (5 + frame) * other_drift;
    }
  }
  Interval paired = paired_ratio(a, b), apart = paired_ratio(c, b);
  EXPECT_NEAR(paired.high - paired.low, 0, 1e-12);
  EXPECT_GT(apart.high - apart.low, 0.01);
}

TEST(PairedRatio, SurvivesZerosAndHoles) {
  EXPECT_TRUE(std::isnan(paired_ratio({}, {}).value));
  EXPECT_TRUE(std::isnan(paired_ratio({{1}}, {{0}}).value));
  EXPECT_TRUE(std::isnan(paired_ratio({{0}}, {{0}}).value));
  EXPECT_TRUE(std::isnan(paired_ratio({{nan, nan}}, {{1, 1}}).high));
  Interval some = paired_ratio({{4, 0, nan, 6}, {4, 0, 1, 6}}, {{2, 1, 0, 3}, {2, 1, 0, 3}});
  EXPECT_DOUBLE_EQ(some.value, 2);
  EXPECT_DOUBLE_EQ(some.low, 2);
  EXPECT_DOUBLE_EQ(some.high, 2);
  Interval uneven = paired_ratio({{2, 4, 8}, {2, 4}}, {{1, 2}, {1, 2}, {1, 2}});
  EXPECT_DOUBLE_EQ(uneven.value, 2);
  Interval single = paired_ratio({{3, 3}}, {{2, 2}});
  EXPECT_EQ(single.low, single.value);
  EXPECT_EQ(single.high, 1.5);
}

// No real difference is called one in about 5 % of experiments, not more than 10 %.
TEST(PairedRatio, IntervalsCoverTheTruth) {
  Random random(12);
  constexpr int experiments = 300;
  int covered = 0;
  for (uint32_t experiment = 0; experiment < experiments; ++experiment) {
    Laps a(15, std::vector<double>(5)), b = a;
    for (int lap = 0; lap < 15; ++lap) {
      double drift = 0.3 * noise(random);
      for (int frame = 0; frame < 5; ++frame) {
        a[lap][frame] = 20 + drift + 0.5 * noise(random);
        b[lap][frame] = 20 + drift + 0.5 * noise(random);
      }
    }
    Interval interval = paired_ratio(a, b, experiment);
    covered += interval.low <= 1 && 1 <= interval.high;
  }
  EXPECT_GE(covered, 0.90 * experiments);
}

}  // namespace
}  // namespace ml
