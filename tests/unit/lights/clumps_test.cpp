#include "harness/lights/clumps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/lights/set.h"
#include "scenes/scene_registry.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

const Scene& arena() {
  static const Scene scene = make_scene("arena");
  return scene;
}

TEST(Clumps, HoldSixtyPercentOfTheLightsCloseTogether) {
  LightSpec spec = spec_of(20000, Placement::clumps);
  LightSet set(spec, arena());
  struct Sum {
    double count = 0;
    glm::dvec3 first{0}, second{0};
  };
  std::vector<Sum> clumps(kClumps);
  double clumped = 0;
  for (uint32_t i = 0; i < set.base().size(); ++i) {
    std::optional<uint32_t> clump = clump_of(LightNumbers(hash_u32(spec.seed), i));
    if (!clump) continue;
    ASSERT_LT(*clump, kClumps);
    ++clumped;
    Sum& sum = clumps[*clump];
    ++sum.count;
    sum.first += set.base()[i].position;
    sum.second += set.base()[i].position * set.base()[i].position;
  }
  EXPECT_NEAR(clumped / 20000, 0.6, 0.015);
  for (const Sum& sum : clumps) {
    EXPECT_NEAR(sum.count, clumped / kClumps, 0.2 * clumped / kClumps);
    glm::dvec3 mean = sum.first / sum.count, variance = sum.second / sum.count - mean * mean;
    EXPECT_NEAR(std::sqrt(variance.x), 2.5, 0.25);
    EXPECT_NEAR(std::sqrt(variance.z), 2.5, 0.25);
    EXPECT_NEAR(std::sqrt(variance.y), 0.75, 0.1);
  }
}

TEST(Clumps, RadiiFallWithTheCountWithoutAJump) {
  double last = 1e9;
  for (uint32_t count : {1u, 49u, 50u, 51u, 499u, 500u, 501u, 2700u, 3239u, 3240u, 3241u, 65536u, 1048576u}) {
    double smallest = clump_smallest_radius(count, arena());
    EXPECT_LE(smallest, last) << count;
    EXPECT_GT(smallest, 0);
    EXPECT_GE(clump_radius_ratio(count), 4);
    EXPECT_LE(clump_radius_ratio(count), 6);
    last = smallest;
  }
  for (uint32_t count : {50u, 500u, 3240u})
    EXPECT_NEAR(clump_smallest_radius(count + 1, arena()), clump_smallest_radius(count, arena()), 0.05);
}

TEST(Clumps, StandOnOtherLevelsToo) {
  for (const char* name : {"canyon", "museum", "grove"}) {
    Scene scene = make_scene(name);
    LightSet set(spec_of(1000, Placement::clumps), scene);
    ASSERT_EQ(set.base().size(), 1000u) << name;
    for (const Light& light : set.base()) {
      EXPECT_GT(light.position.y, double{scene.bounds.min.y} - 5) << name;
      EXPECT_LT(light.position.y, double{scene.bounds.max.y} + 20) << name;
    }
  }
}

TEST(Clumps, LightsOfAClumpOrbitTogetherAndAllComeAndGo) {
  LightSpec spec = spec_of(3240, Placement::clumps);
  spec.script = LightScript::orbit;
  LightSet set(spec, arena());
  const uint32_t seed_hash = hash_u32(spec.seed);
  std::vector<Light> out;
  double shown = 0;
  for (uint32_t frame = 0; frame < 40; ++frame) {
    set.at(frame, 40, 40, out);
    shown += static_cast<double>(out.size());
    std::vector<std::optional<glm::dvec3>> shift(kClumps);
    uint32_t base = 0, clumped = 0;
    for (const Light& light : out) {
      ASSERT_EQ(rejection_reason(light), nullptr);
      // Ascending identity: heights and colours tell lights apart.
      auto hue = [](const Light& of) {
        return of.intensity / (of.intensity.x + of.intensity.y + of.intensity.z);
      };
      auto same = [&](const Light& other) {
        return other.position.y == light.position.y && glm::length(hue(other) - hue(light)) < 1e-5f;
      };
      while (base < set.base().size() && !same(set.base()[base])) ++base;
      ASSERT_LT(base, set.base().size());
      glm::dvec3 moved = light.position - set.base()[base].position;
      std::optional<uint32_t> clump = clump_of(LightNumbers(seed_hash, base));
      ++base;
      if (!clump) continue;
      ++clumped;
      if (!shift[*clump]) shift[*clump] = moved;
      EXPECT_LT(glm::length(*shift[*clump] - moved), 1e-9);
      EXPECT_GE(glm::length(moved), 1.99);
      EXPECT_LE(glm::length(moved), 6.01);
    }
    EXPECT_GT(clumped, 0.3 * 3240);
  }
  EXPECT_NEAR(shown / (40 * 3240), 0.7, 0.02);
}

}  // namespace
}  // namespace ml
