#include "algorithms/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/base/error.h"

namespace ml {
namespace {

std::vector<ParameterInfo> infos() {
  return {ParameterInfo::integer("tile", 24, 4, 1024, "px"), ParameterInfo::real("zmin", 5, 0.01, 1e6, "m"),
          ParameterInfo::boolean("refinement", false, ""),
          ParameterInfo::choice("data", "indexed", {"indexed", "copied"}, "")};
}

std::string refusal(const std::string& name, const ParameterValue& value) {
  Parameters parameters(infos());
  Parameters before = parameters;
  try {
    parameters.set(infos(), name, value, "FILE: $.x");
  } catch (const UsageError& error) {
    EXPECT_EQ(parameters.values(), before.values()) << "a refused value changed something";
    EXPECT_TRUE(std::string(error.what()).starts_with("FILE: $.x: ")) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted a wrong value for " << name;
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

TEST(Parameters, BeginAsTheDefaults) {
  Parameters parameters(infos());
  EXPECT_EQ(parameters.values().size(), 4u);
  EXPECT_EQ(parameters.integer("tile"), 24);
  EXPECT_EQ(parameters.real("zmin"), 5);
  EXPECT_FALSE(parameters.boolean("refinement"));
  EXPECT_EQ(parameters.choice("data"), "indexed");
}

TEST(Parameters, TakeEveryValueOfTheirRange) {
  Parameters parameters(infos());
  for (int64_t tile = 4; tile <= 1024; ++tile) {
    parameters.set(infos(), "tile", tile, "x");
    ASSERT_EQ(parameters.integer("tile"), tile);
  }
  for (double zmin : {0.01, 1.5, 1e6}) {
    parameters.set(infos(), "zmin", zmin, "x");
    EXPECT_EQ(parameters.real("zmin"), zmin);
  }
  parameters.set(infos(), "zmin", int64_t{7}, "x");
  EXPECT_EQ(parameters.real("zmin"), 7);
  parameters.set(infos(), "refinement", true, "x");
  EXPECT_TRUE(parameters.boolean("refinement"));
  parameters.set(infos(), "data", std::string("copied"), "x");
  EXPECT_EQ(parameters.choice("data"), "copied");
}

TEST(Parameters, RefuseWhatIsOutOfRange) {
  for (int64_t tile : {int64_t{3}, int64_t{1025}, int64_t{0}, int64_t{-1}, INT64_MIN, INT64_MAX}) {
    EXPECT_TRUE(
        says(refusal("tile", tile), "expected an integer from 4 to 1024, found " + std::to_string(tile)));
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (double zmin : {0.0, -1.0, 0.0099, 1e7, infinity, -infinity, std::nan("")}) {
    EXPECT_TRUE(says(refusal("zmin", zmin), "expected a number from 0.01"));
  }
}

TEST(Parameters, RefuseOtherTypes) {
  refusal("tile", 16.0);
  refusal("tile", true);
  refusal("tile", std::string("16"));
  refusal("zmin", true);
  refusal("zmin", std::string("5"));
  refusal("refinement", int64_t{1});
  refusal("refinement", std::string("true"));
  refusal("data", int64_t{0});
}

TEST(Parameters, SuggestTheNearestName) {
  EXPECT_TRUE(says(refusal("tiel", int64_t{16}), "unknown parameter 'tiel', did you mean 'tile'?"));
  EXPECT_TRUE(says(refusal("data", std::string("indexd")), "did you mean 'indexed'?"));
  EXPECT_TRUE(says(refusal("something_else", true), "known are tile, zmin, refinement, data"));
  Parameters none;
  EXPECT_THROW(none.set({}, "tile", int64_t{1}, "x"), UsageError);
}

}  // namespace
}  // namespace ml
