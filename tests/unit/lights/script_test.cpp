#include <gtest/gtest.h>

#include <set>

#include "tests/support/light_test_level.h"

namespace ml {
namespace {

TEST(LightScripts, AreFunctionsOfTheFrameAlone) {
  for (LightScript script : {LightScript::none, LightScript::drift, LightScript::spawn, LightScript::orbit}) {
    LightSpec spec = spec_of(3000);
    spec.script = script;
    LightSet set(spec, level());
    std::vector<Light> there, back;
    set.at(7, 120, 40, there);
    for (uint32_t frame : {0u, 119u, 7u}) set.at(frame, 120, 40, back);
    EXPECT_TRUE(same_bits(there, back));
    set.at(8, 120, 40, back);
    EXPECT_EQ(same_bits(there, back), script == LightScript::none);
    // A camera that stands still does not stop the lights.
    set.at(1, 10, 0, there);
    set.at(2, 10, 0, back);
    EXPECT_EQ(same_bits(there, back), script == LightScript::none);
  }
}

TEST(LightScripts, DriftStaysWithinTheRadiusAndComesRound) {
  LightSpec spec = spec_of(2000);
  spec.script = LightScript::drift;
  LightSet set(spec, level());
  std::vector<Light> out;
  double moved = 0;
  for (uint32_t frame = 0; frame < 100; ++frame) {
    set.at(frame, 100, 40, out);
    ASSERT_EQ(out.size(), set.base().size());
    for (size_t i = 0; i < out.size(); ++i) {
      double distance = glm::length(out[i].position - set.base()[i].position);
      EXPECT_LE(distance, out[i].radius);
      EXPECT_EQ(out[i].position.y, set.base()[i].position.y);
      moved += distance / out[i].radius;
    }
  }
  EXPECT_GT(moved / (100 * 2000), 0.2);
}

TEST(LightScripts, SpawnShowsAboutSeventyPercentAndFadesByTheRadius) {
  LightSpec spec = spec_of(4000);
  spec.script = LightScript::spawn;
  LightSet set(spec, level());
  std::vector<Light> out;
  double shown = 0;
  std::set<double> seen;
  for (uint32_t frame = 0; frame < 60; ++frame) {
    set.at(frame, 60, 30, out);
    shown += static_cast<double>(out.size());
    size_t base = 0;
    for (const Light& light : out) {
      ASSERT_EQ(rejection_reason(light), nullptr);
      // Ascending identity: every light is found further on in the base.
      while (base < set.base().size() && set.base()[base].position != light.position) ++base;
      ASSERT_LT(base, set.base().size());
      double fade = light.radius / set.base()[base].radius;
      EXPECT_LE(fade, 1);
      EXPECT_NEAR(light.intensity.x / set.base()[base].intensity.x, fade * fade, 1e-5);
      seen.insert(light.position.x);
    }
  }
  EXPECT_NEAR(shown / (60 * 4000), 0.7, 0.02);
  EXPECT_GT(seen.size(), 3990u);
}

TEST(LightScripts, ASteadyFrameAllocatesNothing) {
  for (LightScript script : {LightScript::none, LightScript::drift, LightScript::spawn, LightScript::orbit}) {
    LightSpec spec = spec_of(5000);
    spec.script = script;
    LightSet set(spec, level());
    std::vector<Light> out;
    set.at(0, 50, 10, out);
    const Light* address = out.data();
    size_t capacity = out.capacity();
    for (uint32_t frame = 1; frame < 50; ++frame) {
      set.at(frame, 50, 10, out);
      EXPECT_EQ(out.data(), address);
      EXPECT_EQ(out.capacity(), capacity);
    }
  }
}

// Spawning lights stand still, so each can be told by its position.
TEST(LightScripts, IdentityIsTheIndexInTheSet) {
  for (LightScript script : {LightScript::none, LightScript::spawn}) {
    LightSpec spec = spec_of(500);
    spec.script = script;
    const LightSet set(spec, level());
    std::vector<Light> out;
    std::vector<uint32_t> identity;
    for (uint32_t frame = 0; frame < 20; ++frame) {
      set.at(frame, 20, 30, out, &identity);
      ASSERT_EQ(identity.size(), out.size());
      for (size_t i = 0; i < out.size(); ++i) {
        EXPECT_TRUE(i == 0 || identity[i - 1] < identity[i]);
        ASSERT_EQ(out[i].position, set.base().at(identity[i]).position) << frame;
      }
    }
    EXPECT_EQ(out.size() == set.base().size(), script == LightScript::none);
  }
}

}  // namespace
}  // namespace ml
