#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

#include "harness/config/config.h"
#include "random_config.h"

namespace ml {
namespace {

using nlohmann::json;

std::vector<std::string> ids(const std::string& text) {
  std::vector<std::string> result;
  for (const Case& each : expand_cases(parse_config_text(text, "x.json", "/levels")))
    result.push_back(each.id);
  return result;
}

void expect_good(const std::vector<Case>& cases, const Config& config) {
  std::set<std::string> seen;
  std::set<std::pair<size_t, size_t>> indices;
  size_t expected = 0;
  for (const ml::Setup& setup : config.setups) expected += setup.algorithms.size();
  RC_ASSERT(cases.size() == expected);
  for (const Case& each : cases) {
    RC_ASSERT(!each.id.empty() && each.id.size() <= 120);
    RC_ASSERT(each.id.find_first_not_of(
                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") == each.id.npos);
    RC_ASSERT(each.id[0] != '.' && each.id[0] != '-');
    RC_ASSERT(seen.insert(each.id).second);
    RC_ASSERT(each.setup < config.setups.size());
    RC_ASSERT(each.algorithm < config.setups[each.setup].algorithms.size());
    RC_ASSERT(indices.insert({each.setup, each.algorithm}).second);
  }
}

TEST(CaseIds, AreUniqueAndFitForFileNames) {
  EXPECT_TRUE(rc::check([] {
    Config config = parse_config(random_config(), "x.json", "/levels");
    expect_good(expand_cases(config), config);
  }));
}

TEST(CaseIds, AreReadable) {
  EXPECT_EQ(
      ids(R"({"algorithms": ["clustered", {"name": "clustered", "tile": 32}]})"),
      (std::vector<std::string>{"canyon-8192-960x540-clustered", "canyon-8192-960x540-clustered-tile32"}));
  std::vector<std::string> changed = ids(
      R"({"algorithms": [{"name": "clustered", "zmin": 2.5, "refinement": true, "light_data": "duplicated"}]})");
  ASSERT_EQ(changed.size(), 1u);
  for (const char* part :
       {"canyon-8192-960x540-clustered", "-zmin2.5", "-refinement", "-light_data-duplicated"}) {
    EXPECT_NE(changed[0].find(part), std::string::npos) << changed[0];
  }
}

TEST(CaseIds, LargeAndSmallNumbersStayApart) {
  std::vector<std::string> both = ids(R"({"algorithms": [{"name": "clustered", "zmin": [0.0625, 1e6]}]})");
  EXPECT_EQ(both, (std::vector<std::string>{"canyon-8192-960x540-clustered-zmin0.0625",
                                            "canyon-8192-960x540-clustered-zmin1000000"}));
  EXPECT_EQ(ids(R"({"algorithms": ["ideal"], "sweep": {"lights.intensity": [1e9, 1e-9]}})"),
            (std::vector<std::string>{"canyon-8192-960x540-lights.intensity1000000000-ideal",
                                      "canyon-8192-960x540-lights.intensity1e-09-ideal"}));
}

TEST(CaseIds, SayWhatTheSweepChanges) {
  EXPECT_EQ(ids(R"({"algorithms": ["ideal"], "sweep": {"lights.seed": [3, 4]}})"),
            (std::vector<std::string>{"canyon-8192-960x540-lights.seed3-ideal",
                                      "canyon-8192-960x540-lights.seed4-ideal"}));
  EXPECT_EQ(ids(R"({"algorithms": ["ideal"], "sweep": {"lights.count": [3, 4]}})"),
            (std::vector<std::string>{"canyon-3-960x540-ideal", "canyon-4-960x540-ideal"}));
}

TEST(CaseIds, EqualCasesAreNumbered) {
  EXPECT_EQ(ids(R"({"algorithms": ["ideal", "ideal", "ideal"]})"),
            (std::vector<std::string>{"canyon-8192-960x540-ideal", "canyon-8192-960x540-ideal-2",
                                      "canyon-8192-960x540-ideal-3"}));
}

TEST(CaseIds, OddFileNamesBecomePlainLetters) {
  for (const char* file :
       {"../../etc/passwd", "..", "a b\\u00e9/\\u00fc \\u00fc.glb", "-rf.glb", "...glb", "con:aux*?.glb"}) {
    std::string text = std::string(R"({"algorithms": ["ideal"], "scene": {"gltf": ")") + file + "\"}}";
    Config config = parse_config_text(text, "x.json", "/levels");
    EXPECT_TRUE(rc::check([&] { expect_good(expand_cases(config), config); }));
  }
  std::string longest(200, 'x');
  EXPECT_TRUE(rc::check([&] {
    Config config = parse_config(
        {{"scene", {{"gltf", longest + ".glb"}}},
         {"algorithms", {{{"name", "clustered"}, {"zmin", {0.123456789, 0.23456789}}, {"tile", {8, 16}}}}},
         {"sweep",
          {{"scene.offset", {{1.23456789, 2.3456789, 3.456789}, {4.56789, 5.6789, 6.789}}},
           {"lights.base_size", {0.1234567, 0.2345678}}}}},
        "x", "/levels");
    expect_good(expand_cases(config), config);
  }));
}

}  // namespace
}  // namespace ml
