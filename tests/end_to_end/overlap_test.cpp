// List building beside shadow maps, as a result tells it.
#include <algorithm>

#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

json overlap_config(const json& shading, const json& changes = json::object()) {
  json config = small_config({{"algorithms", {"fine_pruned", "clustered"}},
                              {"lights", all_shapes(60)},
                              {"resolution", {80, 45}},
                              {"shading", shading},
                              {"outputs", {{"images", {1}}, {"trace", true}}}});
  config.update(changes);
  return config;
}

json run(const Folder& folder, const std::string& name, const json& config,
         const ProcessOptions& options = {}) {
  Outcome outcome = manylights({"run", write_config(folder, config, name + ".json"), "--out",
                                (folder / name).string(), "--validation", "--quiet"},
                               options);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(outcome.error.empty()) << outcome.error;
  return valid_result(folder / name);
}

const json& case_of(const json& result, const std::string& algorithm) {
  for (const json& one : result["cases"])
    if (one["algorithm"] == algorithm) return one;
  throw std::logic_error("no case of " + algorithm);
}

std::string note_of(const json& one) {
  return one["overlap"]["note"];
}

TEST(Overlap, IsSaidOfEveryCase) {
  Folder folder;
  const json result =
      run(folder, "compute",
          overlap_config({{"list_queue", "compute"}, {"shadow_maps", 2}, {"shadow_map_size", 64}}));
  const json &device = result["context"]["device"], &pruned = case_of(result, "fine_pruned"),
             &clustered = case_of(result, "clustered");
  EXPECT_EQ(pruned["overlap"]["list_queue"], "compute");
  for (const json& one : {pruned, clustered}) {
    EXPECT_TRUE(one["gpu_ms"].contains("shadow_maps"));
    EXPECT_EQ(one["memory_bytes"]["shadow_maps"], 2 * 64 * 64 * 4);
    for (const json& lost : one["counters"]["lost"]) EXPECT_EQ(lost, 0);
    EXPECT_EQ(one["overlap"]["overlapped"].get<bool>(), note_of(one).empty());
  }
  EXPECT_NE(note_of(clustered).find("builds no lists on the device"), std::string::npos);
  EXPECT_TRUE(clustered["overlap"]["ms"].empty());
  if (device["second_queue"] == "none") {
    EXPECT_NE(note_of(pruned).find("one queue"), std::string::npos) << note_of(pruned);
    EXPECT_EQ(pruned["overlap"]["ms"], json::array({json::array({0.0, 0.0})}));
  } else if (device["second_timestamp_valid_bits"] == 0) {
    EXPECT_NE(note_of(pruned).find("no timestamps"), std::string::npos) << note_of(pruned);
    EXPECT_FALSE(pruned["gpu_ms"].contains("lists"));
  } else {
    EXPECT_EQ(pruned["overlap"]["ms"].size(), 1u);
  }
}

TEST(Overlap, ChangesNeitherListsNorPictures) {
  Folder folder;
  const json shadows{{"shadow_maps", 1}, {"shadow_map_size", 32}};
  json graphics = shadows, compute = shadows;
  compute["list_queue"] = "compute";
  const json none = run(folder, "none", overlap_config(json::object())),
             before = run(folder, "before", overlap_config(graphics)),
             beside = run(folder, "beside", overlap_config(compute));
  EXPECT_FALSE(case_of(none, "fine_pruned")["gpu_ms"].contains("shadow_maps"));
  EXPECT_FALSE(case_of(none, "fine_pruned")["memory_bytes"].contains("shadow_maps"));
  for (const char* algorithm : {"fine_pruned", "clustered"}) {
    const json& expected = case_of(none, algorithm);
    for (const auto& [name, result] : {std::pair<std::string, const json&>{"before", before},
                                       std::pair<std::string, const json&>{"beside", beside}}) {
      const json& one = case_of(result, algorithm);
      EXPECT_EQ(one["counters"], expected["counters"]) << algorithm << ", " << name;
      for (const json& file : one["files"]["images"]) {
        const std::string path = file;
        EXPECT_TRUE(text_of(folder / name / path) == text_of(folder / "none" / path)) << path;
      }
    }
  }
}

TEST(Overlap, WhatCannotBeSeenIsNotClaimed) {
  Folder folder;
  const json compute{{"list_queue", "compute"}, {"shadow_maps", 1}, {"shadow_map_size", 32}};
  const json whole =
      run(folder, "whole",
          overlap_config(compute, {{"measure", {{"warmup", 0}, {"repeats", 1}, {"mode", "whole"}}}}));
  EXPECT_FALSE(case_of(whole, "fine_pruned")["overlap"]["overlapped"]);
  EXPECT_TRUE(case_of(whole, "fine_pruned")["overlap"]["ms"].empty());
  const json idle = run(folder, "idle", overlap_config({{"list_queue", "compute"}}));
  EXPECT_FALSE(case_of(idle, "fine_pruned")["overlap"]["overlapped"]);
  const json plain = run(folder, "plain", overlap_config({{"shadow_maps", 1}, {"shadow_map_size", 32}}));
  EXPECT_EQ(note_of(case_of(plain, "fine_pruned")), "shading.list_queue is graphics");
}

TEST(Overlap, EveryClaimHolds) {
  Folder folder;
  const json config = overlap_config(
      {{"list_queue", "compute"}, {"shadow_maps", 2}, {"shadow_map_size", 64}, {"targets", "split"}});
  Outcome outcome = manylights({"verify", write_config(folder, config), "--validation", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.error;
}

// The device seems to have a second queue (tests/layer): KIND:BITS. The loader stacks layers in the order in
// which it finds them; the validation layer is to be the upper one.
ProcessOptions two_queues(const std::string& kind) {
  ProcessOptions options;
  options.environment = {{"VK_ADD_LAYER_PATH", "/usr/share/vulkan/explicit_layer.d:" ML_LAYER_FOLDER},
                         {"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation:VK_LAYER_ML_two_queues"},
                         {"ML_TWO_QUEUES", kind}};
  return options;
}

class TwoQueues : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string listed = manylights({"list", "devices"}).out;
    if (listed.find("second queue: none") == listed.npos) GTEST_SKIP() << "the device has two of its own";
  }
  std::string kind() const { return GetParam(); }
  std::string family() const { return kind().starts_with("main") ? "main family" : "compute family"; }
};

TEST_P(TwoQueues, AreListed) {
  for (const char* command : {"list", "doctor"}) {
    const Outcome outcome = std::string(command) == "list"
                                ? manylights({"list", "devices"}, two_queues(kind()))
                                : manylights({"doctor"}, two_queues(kind()));
    EXPECT_NE(outcome.out.find("second queue: " + family()), std::string::npos) << outcome.out;
  }
}

TEST_P(TwoQueues, BuildTheSameListsAndTheLayerHasNothingToSay) {
  Folder folder;
  const json shading{
      {"list_queue", "compute"}, {"shadow_maps", 2}, {"shadow_map_size", 64}, {"targets", "split"}};
  const json config = overlap_config(shading), one = run(folder, "one", config),
             two = run(folder, "two", config, two_queues(kind()));
  EXPECT_EQ(two["context"]["device"]["second_queue"], family());
  const json &pruned = case_of(two, "fine_pruned"), &expected = case_of(one, "fine_pruned");
  EXPECT_EQ(pruned["counters"], expected["counters"]);
  for (const json& file : expected["files"]["images"]) {
    const std::string path = file;
    EXPECT_TRUE(text_of(folder / "one" / path) == text_of(folder / "two" / path)) << path;
  }
  if (kind() == "compute:0") {
    EXPECT_EQ(note_of(pruned), "the device's second queue has no timestamps");
    EXPECT_TRUE(pruned["overlap"]["ms"].empty());
    EXPECT_FALSE(pruned["gpu_ms"].contains("lists"));
  } else {
    // There is one queue in truth: the stamps say that nothing ran together.
    EXPECT_EQ(pruned["overlap"]["ms"], json::array({json::array({0.0, 0.0})}));
    EXPECT_NE(note_of(pruned).find("not seen to run"), std::string::npos) << note_of(pruned);
    EXPECT_TRUE(pruned["gpu_ms"].contains("lists"));
  }
  EXPECT_FALSE(pruned["overlap"]["overlapped"]);
}

TEST_P(TwoQueues, EveryClaimHolds) {
  Folder folder;
  const json config = overlap_config({{"list_queue", "compute"}, {"shadow_maps", 1}});
  Outcome outcome =
      manylights({"verify", write_config(folder, config), "--validation", "--quiet"}, two_queues(kind()));
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("the validation layer has nothing to say"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Of, TwoQueues, testing::Values("compute:64", "compute:36", "compute:0", "main:64"),
                         [](const auto& given) {
                           std::string name = given.param;
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

}  // namespace
}  // namespace ml::test
