#include "harness/lights/radius_distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/random.h"
#include "harness/scene/turn.h"
#include "scenes/scene_registry.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

TEST(RadiusDistribution, MomentsAreThoseOfABoundedPareto) {
  RadiusMoments moments = radius_moments(32);
  EXPECT_NEAR(moments.mean, 1.94, 0.005);
  EXPECT_NEAR(moments.square, 6.94, 0.005);
  EXPECT_NEAR(moments.cube, 62.1, 0.1);
  for (float ratio : {1.0f, 2.0f, 32.0f, 1000.0f}) {
    // The midpoint rule in u over the distribution itself.
    double mean = 0, square = 0, cube = 0;
    constexpr int kSteps = 1 << 22;
    for (int i = 0; i < kSteps; ++i) {
      double r = pareto_radius(static_cast<float>((i + 0.5) / kSteps), 1, ratio);
      mean += r / kSteps;
      square += r * r / kSteps;
      cube += r * r * r / kSteps;
    }
    RadiusMoments formula = radius_moments(static_cast<double>(ratio));
    EXPECT_NEAR(mean / formula.mean, 1, 2e-3) << ratio;
    EXPECT_NEAR(square / formula.square, 1, 1e-2) << ratio;
    EXPECT_NEAR(cube / formula.cube, 1, ratio > 100 ? 0.2 : 2e-2) << ratio;
  }
}

TEST(RadiusDistribution, RadiiStayBetweenTheirEnds) {
  for (float s : {0.01f, 0.6f, 7.0f}) {
    EXPECT_EQ(pareto_radius(0, s, 32), s);
    float last = 0;
    for (uint32_t i = 0; i < 4096; ++i) {
      float r = pareto_radius(static_cast<float>(i) / 4096, s, 32);
      EXPECT_GE(r, last);
      last = r;
    }
    EXPECT_LE(pareto_radius(unit_float(0xffffffffu), s, 32), s * 32.001f);
    EXPECT_EQ(pareto_radius(0.7f, s, 1), s);
  }
}

TEST(RadiusDistribution, OverdrawStaysOrGrowsWithTheCount) {
  for (Placement placement : {Placement::volume, Placement::area, Placement::triangle}) {
    double power = placement == Placement::volume ? 3 : 2;
    double first = -1;
    for (uint32_t count : {1u, 100u, 65536u, 1048576u}) {
      double s = size_for_count(0.7, count, Sizing::const_overdraw, placement);
      double overdraw = count * std::pow(s, power);
      if (first < 0) first = overdraw;
      EXPECT_NEAR(overdraw / first, 1, 1e-12);
      EXPECT_EQ(size_for_count(0.7, count, Sizing::fixed_size, placement), 0.7);
    }
    EXPECT_EQ(size_for_count(0.7, 65536, Sizing::const_overdraw, placement), 0.7);
  }
}

TEST(RadiusDistribution, TheCanyonHasItsOwnSizeAndOtherLevelsAboutThreeLightsPerPoint) {
  Scene canyon;
  canyon.light_defaults = describe_scene("canyon").lights;
  EXPECT_EQ(default_base_size(canyon, Placement::volume, 32), 0.6);
  double s = default_base_size(level(), Placement::volume, 32);
  EXPECT_NEAR(0.7 * 65536 * (4 * 3.14159265 / 3) * radius_moments(32).cube * s * s * s / (40 * 20 * 10), 3,
              1e-3);
  EXPECT_GT(default_base_size(make_scene("plane"), Placement::volume, 32), 0);
  EXPECT_EQ(default_base_size(Scene(), Placement::volume, 32), 1);
}

TEST(SineOfTurns, IsTheSine) {
  for (int i = -4000; i <= 4000; ++i) {
    double turns = i / 777.0;
    EXPECT_NEAR(sine_of_turns(turns), std::sin(turns * 6.283185307179586), 1e-11);
    EXPECT_NEAR(cosine_of_turns(turns), std::cos(turns * 6.283185307179586), 1e-11);
  }
}

}  // namespace
}  // namespace ml
