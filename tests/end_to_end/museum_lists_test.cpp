// The museum's lists as its description has them. Their lengths were given without the test that made them;
// of those that can be asked for, rectangles of the lights' smallest balls before pruning and lights that
// reach a surface facing them after it come nearest to all: over 16 frames 31 lights a tile (30.7) and most
// 84 (67), 2.2 (2.4) and most 17 (16) after pruning; with 400 lights 36 % of the tiles have more than 64 (45
// %), and most are 35 (36) after it.
#include <numeric>

#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

double mean_of(const json& counters, const char* name) {
  const std::vector<double> of_frames = counters.at(name);
  return std::reduce(of_frames.begin(), of_frames.end()) / static_cast<double>(of_frames.size());
}

TEST(MuseumLists, AreAsLongAsTheDescriptionHasThem) {
  Folder folder;
  const json pruned = {{"name", "fine_pruned"},
                       {"prune", "facing"},
                       {"bounds", "ball"},
                       {"tile_depths", false},
                       {"caps", "paper"}};
  const std::vector<std::pair<std::string, json>> changes = {{"camera.frames", 16},
                                                             {"measure.repeats", 1},
                                                             {"measure.warmup", 0},
                                                             {"algorithms", json::array({pruned})},
                                                             {"outputs.images", json::array()},
                                                             {"outputs.heatmaps", json::array()},
                                                             {"sweep", {{"lights.count", {200, 400}}}}};
  std::vector<std::string> arguments = {"run", "museum", "--out", (folder / "out").string(), "--quiet"};
  for (const auto& [key, value] : changes) {
    arguments.emplace_back("--set");
    arguments.push_back(key + "=" + value.dump());
  }
  const Outcome outcome = manylights(arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const json result = valid_result(folder / "out");
  ASSERT_EQ(result["cases"].size(), 2u);
  const json &few = result["cases"][0]["counters"], &many = result["cases"][1]["counters"];
  const double tiles = 80 * 45;
  EXPECT_NEAR(mean_of(few, "coarse_lights"), 30.7, 0.15 * 30.7);
  EXPECT_NEAR(mean_of(few, "fine_lights"), 2.4, 0.2 * 2.4);
  EXPECT_GE(mean_of(few, "coarse_lights"), 10 * mean_of(few, "fine_lights"));
  EXPECT_LT(mean_of(few, "overflow_tiles"), 0.05 * tiles);
  // More than 64 lights before pruning: the overflow case.
  EXPECT_NEAR(mean_of(many, "overflow_tiles"), 0.45 * tiles, 0.3 * 0.45 * tiles);
}

}  // namespace
}  // namespace ml::test
