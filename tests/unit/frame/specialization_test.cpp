// Specialization constants go by their names: what a program lacks, and what of its own it is not given, is an
// error and never silence.
#include "harness/gpu/specialization.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ml::gpu {
namespace {

const ConstantIds shading{{"EFFECT_SPOTS", 0}, {"LONG_LISTS", 20}, {"DUPLICATED", 32}};

std::string refusal(const std::vector<ConstantIds>& modules, const Constants& constants) {
  try {
    specialization_values(modules, constants, "shade");
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(Specialization, GivesEveryModuleItsValuesByName) {
  const Constants constants{{"EFFECT_SPOTS", 1, true}, {"EFFECT_NOBODY_HAS", 1, true}, {"DUPLICATED", 7}};
  const auto values = specialization_values({shading, {{"EFFECT_SPOTS", 5}}}, constants, "shade");
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(values[0], (SpecializationValues{{0, 1}, {32, 7}}));
  EXPECT_EQ(values[1], (SpecializationValues{{5, 1}}));
}

TEST(Specialization, TakesTheLaterOfTwoValues) {
  const Constants constants{{"LONG_LISTS", 0, true}, {"DUPLICATED", 0}, {"LONG_LISTS", 1}};
  EXPECT_EQ(specialization_values({shading}, constants, "shade")[0].at(20), 1u);
}

TEST(Specialization, RefusesWhatTheProgramLacks) {
  EXPECT_EQ(refusal({shading}, {{"DUPLICATED", 0}, {"NARROW", 1}}), "shade: it has no constant NARROW");
  // One module of several is enough.
  EXPECT_EQ(refusal({{{"A", 1}}, {{"B", 1}}}, {{"A", 0}, {"B", 0}}), "");
}

TEST(Specialization, RefusesAProgramWhoseOwnConstantsAreNotGiven) {
  EXPECT_EQ(refusal({shading}, {{"LONG_LISTS", 0}}), "shade: its constant DUPLICATED is given no value");
}

TEST(Specialization, RefusesTwoConstantsOfOneId) {
  EXPECT_EQ(refusal({{{"A", 32}, {"B", 32}}}, {{"A", 0}, {"B", 0}}),
            "shade: two of its constants have constant_id 32");
}

}  // namespace
}  // namespace ml::gpu
