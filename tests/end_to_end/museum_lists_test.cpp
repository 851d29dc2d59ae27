// The museum's lists as its description has them. Their lengths were given without the test that made them;
// of those that can be asked for, rectangles of the lights' smallest balls before pruning and lights that
// reach a surface facing them after it come nearest to all: over 16 frames 31 lights a tile (30.7) and most
// 84 (67), 2.2 (2.4) and most 17 (16) after pruning; with 400 lights 36 % of the tiles have more than 64 (45
// %), and most are 35 (36) after it.
#include <algorithm>
#include <numeric>

#include "algorithms/fine_pruned/pruned_lists.h"
#include "harness/output/picture.h"
#include "tests/end_to_end/program.h"
#include "tests/support/drivers.h"

namespace ml::test {
namespace {

using nlohmann::json;

double mean_of(const json& counters, const char* name) {
  const std::vector<double> of_frames = counters.at(name);
  return std::reduce(of_frames.begin(), of_frames.end()) / static_cast<double>(of_frames.size());
}

// The museum's 16 frames once, with the algorithm and what else is changed.
json museum(const Folder& folder, const json& algorithm, std::vector<std::pair<std::string, json>> changes) {
  changes.insert(changes.end(), {{"camera.frames", 16},
                                 {"measure.repeats", 1},
                                 {"measure.warmup", 0},
                                 {"algorithms", json::array({algorithm})},
                                 {"outputs.images", json::array()}});
  // Lists do not ask how a material is lit, and not every device lights forward materials.
  std::vector<std::string> arguments = {
      "run", "museum", "--out", (folder / "out").string(), "--quiet", "--set", "effects.forward=off"};
  for (const auto& [key, value] : changes) {
    arguments.emplace_back("--set");
    arguments.push_back(key + "=" + value.dump());
  }
  const Outcome outcome = manylights(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  return outcome.code == 0 ? valid_result(folder / "out") : json();
}

TEST(MuseumLists, AreAsLongAsTheDescriptionHasThem) {
  if (on_swiftshader()) GTEST_SKIP() << "takes minutes on SwiftShader";
  Folder folder;
  const json result =
      museum(folder,
             {{"name", "fine_pruned"},
              {"prune", "facing"},
              {"bounds", "ball"},
              {"tile_depths", false},
              {"caps", "paper"}},
             {{"outputs.heatmaps", json::array()}, {"sweep", {{"lights.count", {200, 400}}}}});
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

// Mean over all tiles of the most lights that one of the tile's pixels gets light from: no exact list is
// shorter.
double least_lights_a_tile(const json& result, const std::filesystem::path& out) {
  double sum = 0;
  size_t tiles = 0;
  for (const std::string file : result["cases"][0]["files"]["heatmaps"]) {
    if (!file.ends_with(".contributing.exr")) continue;
    const Picture counts = read_exr(out / file);
    for (uint32_t top = 0; top < counts.height; top += ML_PRUNED_TILE)
      for (uint32_t left = 0; left < counts.width; left += ML_PRUNED_TILE, ++tiles) {
        float max_count = 0;
        for (uint32_t y = top; y < std::min(top + ML_PRUNED_TILE, counts.height); ++y)
          for (uint32_t x = left; x < std::min(left + ML_PRUNED_TILE, counts.width); ++x)
            max_count = std::max(max_count, counts.data[counts.pixel(x, y)]);
        sum += static_cast<double>(max_count);
      }
  }
  EXPECT_EQ(tiles, size_t{16} * 80 * 45);
  return sum / static_cast<double>(tiles);
}

// The chapter's own coarse lists, by hulls and depths, are so short that no exact pruning makes them a tenth:
// a pixel's lights have to stay.
TEST(MuseumLists, OfHullsAndDepthsAreShortAndPrunedNearlyToTheLeast) {
  if (on_swiftshader()) GTEST_SKIP() << "takes minutes on SwiftShader";
  Folder folder;
  std::vector<uint32_t> frames(16);
  std::iota(frames.begin(), frames.end(), 0u);
  const json result = museum(folder, {{"name", "fine_pruned"}, {"prune", "facing"}},
                             {{"outputs.heatmaps", frames}, {"sweep", {{"lights.count", {200}}}}});
  ASSERT_EQ(result["cases"].size(), 1u);
  const json& counters = result["cases"][0]["counters"];
  const double least = least_lights_a_tile(result, folder / "out");
  EXPECT_LT(mean_of(counters, "coarse_lights"), 4 * least);
  EXPECT_GE(mean_of(counters, "fine_lights"), least);
  EXPECT_LT(mean_of(counters, "fine_lights"), 1.05 * least);
}

}  // namespace
}  // namespace ml::test
