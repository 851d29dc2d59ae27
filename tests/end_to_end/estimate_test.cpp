// What a run is said to cost before it is run.
#include "harness/bench/estimate.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "harness/output/result.h"

namespace ml {
namespace {

double seconds(const Config& config) {
  return estimate_run(config, expand_cases(config)).seconds;
}

// The published results were measured on two shared cores: hence no nearer than three times.
TEST(Estimate, IsNearWhatPublishedRunsTook) {
  int runs = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(ML_SOURCE_DIR "/results")) {
    if (file.path().extension() != ".json" || file.path().parent_path().filename() == "schema") continue;
    SCOPED_TRACE(file.path().string());
    const nlohmann::json result = read_result(file.path());
    if (result["context"]["device"]["type"] != "cpu") continue;
    const double took = result["harness"]["wall_ms"].get<double>() / 1000;
    const double said = seconds(parse_config(result["config"], file.path().string(), "."));
    EXPECT_GT(said, took / 3) << took;
    EXPECT_LT(said, took * 3) << took;
    ++runs;
  }
  EXPECT_GT(runs, 0);
}

TEST(Estimate, KnowsWhatEachAlgorithmPaysForMoreLights) {
  auto extra = [](const char* algorithm) {
    auto with = [&](const char* count) {
      return seconds(load_config(
          "quick", {std::string("algorithms=[") + algorithm + "]", std::string("lights.count=") + count}));
    };
    return with("65536") - with("8192");
  };
  // Lists on the device for every tile, much more without regions; each light tested for each pixel.
  EXPECT_GT(extra(R"("fine_pruned")"), 1.1 * extra(R"("clustered")"));
  EXPECT_GT(extra(R"({"name": "fine_pruned", "region_lights": 1048576})"), 2 * extra(R"("fine_pruned")"));
  EXPECT_GT(extra(R"("brute_force")"), 20 * extra(R"("fine_pruned")"));
  EXPECT_GT(extra(R"("light_bvh")"), 0);
}

TEST(Estimate, GrowsWithLapsFramesAndPixels) {
  const double base = seconds(load_config("quick", {}));
  for (const char* more : {"measure.repeats=9", "camera.frames=48", "resolution=[1920,1080]"})
    EXPECT_GT(seconds(load_config("quick", {more})), 1.5 * base) << more;
}

}  // namespace
}  // namespace ml
