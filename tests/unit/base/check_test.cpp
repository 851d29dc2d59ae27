// Checks name the place, the condition and both values, in every build.
#include "harness/base/check.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace ml {
namespace {

template <typename Body>
std::string refusal(Body body) {
  try {
    body();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(Check, SaysWhatDoesNotHoldAndBothValues) {
  const int index = 12;
  const size_t count = 8;
  const std::string text = refusal([&] { ML_CHECK_LT(index, count); });
  EXPECT_NE(text.find("check_test.cpp:"), text.npos) << text;
  EXPECT_EQ(text.find('/'), text.npos) << "a path of the machine that built it: " << text;
  EXPECT_NE(text.find("index < count does not hold: 12 and 8"), text.npos) << text;
  EXPECT_NE(refusal([] { ML_CHECK(2 + 2 == 5); }).find("2 + 2 == 5 does not hold"), std::string::npos);
}

TEST(Check, HoldsInSilence) {
  EXPECT_EQ(refusal([] {
              ML_CHECK(true);
              ML_CHECK_EQ(3, 3u);
              ML_CHECK_NE(std::string("a"), "b");
              ML_CHECK_LT(-1, 0u);
              ML_CHECK_LE(2.5, 2.5);
              ML_CHECK_GT(std::numeric_limits<uint64_t>::max(), -1);
              ML_CHECK_GE(7, 7);
            }),
            "");
}

TEST(Check, ComparesIntegersByValue) {
  EXPECT_NE(refusal([] { ML_CHECK_GT(-1, 0u); }), "");
  EXPECT_NE(refusal([] { ML_CHECK_EQ(-1, std::numeric_limits<uint32_t>::max()); }), "");
}

TEST(Check, EvaluatesEachSideOnce) {
  int calls = 0;
  ML_CHECK_LE([&] { return ++calls; }(), 1);
  EXPECT_EQ(calls, 1);
}

TEST(Check, InHotLoopsOnlyWithAssertions) {
#ifdef NDEBUG
  EXPECT_EQ(refusal([] { ML_DCHECK_LT(2, 1); }), "");
#else
  EXPECT_NE(refusal([] { ML_DCHECK_LT(2, 1); }), "");
#endif
}

}  // namespace
}  // namespace ml
