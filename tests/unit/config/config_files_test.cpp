// Configurations on the disk: shipped ones by name, others by path.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/config/config.h"

namespace ml {
namespace {

namespace fs = std::filesystem;

// A folder of its own, and MANYLIGHTS_CONFIGS pointing to it.
class ConfigFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("manylights-configs-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "papers");
    write_file(folder_ / "small.json", R"({"description": "Small one", "resolution": [8, 8]})");
    write_file(folder_ / "papers" / "figure.json", R"({"scene": {"gltf": "level.glb"}})");
    write_file(folder_ / "broken.json", "{");
    write_file(folder_ / "notes.txt", "not a configuration");
    setenv("MANYLIGHTS_CONFIGS", folder_.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("MANYLIGHTS_CONFIGS");
    fs::remove_all(folder_);
  }
  fs::path folder_;
};

std::string refusal(const std::string& name) {
  try {
    load_config(name, {});
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << name;
  return "";
}

TEST_F(ConfigFolder, IsListedWithSummaries) {
  std::vector<ConfigInfo> infos = known_configs();
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_EQ(infos[0].name, "broken");
  EXPECT_NE(infos[0].summary.find("line 1"), std::string::npos);
  EXPECT_EQ(infos[1].name, "papers/figure");
  EXPECT_EQ(infos[2].name, "small");
  EXPECT_EQ(infos[2].summary, "Small one");
}

TEST_F(ConfigFolder, NamesAndPathsLeadToTheSameFile) {
  Config by_name = load_config("papers/figure", {}),
         by_path = load_config(folder_ / "papers/figure.json", {});
  EXPECT_EQ(by_name.resolved, by_path.resolved);
  EXPECT_EQ(by_name.name, "figure");
  EXPECT_EQ(by_name.setups[0].scene.gltf, folder_ / "papers" / "level.glb");
}

TEST_F(ConfigFolder, OverridesReachNamedConfigs) {
  EXPECT_EQ(load_config("small", {"lights.count=3"}).setups[0].lights.count, 3u);
  EXPECT_EQ(load_config("small", {"lights.count=3"}).setups[0].width, 8u);
}

TEST_F(ConfigFolder, UnknownNamesAreSuggested) {
  EXPECT_NE(refusal("smal").find("did you mean 'small'?"), std::string::npos);
  EXPECT_NE(refusal("smal.json").find("did you mean 'small'?"), std::string::npos);
  EXPECT_NE(refusal("papers/figur").find("did you mean 'papers/figure'?"), std::string::npos);
  EXPECT_NE(refusal("").find("neither a file nor"), std::string::npos);
  EXPECT_NE(refusal("citadel").find("quick --set scene=citadel"), std::string::npos);
  refusal(std::string("a\0b", 3));
  refusal(folder_);
  refusal("../" + folder_.filename().string() + "/small");
}

TEST_F(ConfigFolder, BrokenFilesNameThemselves) {
  EXPECT_NE(refusal("broken").find("broken.json: line 1, column 2"), std::string::npos) << refusal("broken");
}

TEST_F(ConfigFolder, MissingFolderHoldsNothing) {
  setenv("MANYLIGHTS_CONFIGS", "/nowhere/at/all", 1);
  EXPECT_TRUE(known_configs().empty());
  EXPECT_NE(refusal("quick").find("neither a file nor"), std::string::npos);
}

TEST(ShippedConfigs, AllLoad) {
  std::vector<std::string> names;
  for (const ConfigInfo& info : known_configs()) {
    names.push_back(info.name);
    EXPECT_FALSE(info.summary.empty()) << info.name;
    Config config = load_config(info.name, {});
    EXPECT_FALSE(expand_cases(config).empty());
    EXPECT_EQ(config.name, fs::path(info.name).filename().string());
  }
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const char* name : {"quick", "plane", "canyon_65536", "citadel", "grove", "museum", "arena", "room50",
                           "regression/smoke"}) {
    EXPECT_TRUE(std::binary_search(names.begin(), names.end(), name)) << name;
  }
}

TEST(ShippedConfigs, QuickIsWhatTheReadmePromises) {
  Config config = load_config("quick", {});
  ASSERT_EQ(config.setups.size(), 1u);
  const ml::Setup& setup = config.setups[0];
  EXPECT_EQ(setup.scene.procedural, "canyon");
  EXPECT_EQ(setup.width, 960u);
  EXPECT_EQ(setup.height, 540u);
  EXPECT_EQ(setup.camera.frames, 16u);
  EXPECT_EQ(setup.lights.count, 8192u);
  EXPECT_EQ(setup.lights.placement, Placement::volume);
  EXPECT_EQ(setup.lights.sizing, Sizing::const_overdraw);
  EXPECT_EQ(setup.lights.script, LightScript::drift);
  EXPECT_EQ(setup.lights.seed, 1u);
  EXPECT_EQ(config.measure.warmup, 1u);
  EXPECT_EQ(config.measure.repeats, 3u);
  EXPECT_EQ(config.outputs.heatmaps, (std::vector<uint32_t>{0, 8}));
  EXPECT_EQ(config.outputs.images, (std::vector<uint32_t>{0}));
  for (const AlgorithmSpec& spec : setup.algorithms) {
    EXPECT_NE(spec.name, "brute_force");
    // 24 px are the papers' grid of 40 x 23 tiles at this resolution.
    if (spec.name == "clustered") {
      EXPECT_EQ(spec.parameters.integer("tile"), 24);
    }
  }
}

}  // namespace
}  // namespace ml
