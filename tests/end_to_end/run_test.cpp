// Runs: whole ones, repeated ones, shared ones, and those that were stopped.
#include <csignal>
#include <map>
#include <set>

#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

std::set<std::string> ids_of(const json& result) {
  std::set<std::string> ids;
  for (const json& item : result["cases"]) ids.insert(item["id"].get<std::string>());
  return ids;
}

TEST(Run, IsWholeAndTheSameAgain) {
  Folder folder;
  const std::string config = write_config(
      folder, small_config({{"outputs", {{"images", {0, 1}}, {"heatmaps", {1}}, {"trace", true}}},
                            {"lights", {{"count", 200}, {"animate", "drift"}}}}));
  std::map<std::string, std::string> files[2];
  json results[2];
  for (int i = 0; i < 2; ++i) {
    const std::filesystem::path out = folder / ("out" + std::to_string(i));
    Outcome outcome = manylights({"run", config, "--out", out.string(), "--validation", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_TRUE(outcome.error.empty()) << outcome.error;
    results[i] = valid_result(out);
    EXPECT_EQ(results[i]["complete"], true);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
      if (entry.path().extension() == ".exr" || entry.path().extension() == ".png")
        files[i][entry.path().lexically_relative(out).string()] = text_of(entry.path());
    EXPECT_TRUE(std::filesystem::exists(out / "trace.json"));
  }
  ASSERT_EQ(results[0]["cases"].size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const json& one = results[0]["cases"][i];
    EXPECT_EQ(one["counters"], results[1]["cases"][i]["counters"]);
    for (const json& lost : one["counters"]["lost"]) EXPECT_EQ(lost, 0);
    EXPECT_GT(one["counters"]["contributing"][0], 0);
    for (const char* kind : {"images", "heatmaps"})
      for (const json& name : one["files"][kind])
        EXPECT_TRUE(files[0].contains(name.get<std::string>())) << name;
  }
  EXPECT_GE(files[0].size(), 8u);
  EXPECT_EQ(files[0], files[1]) << "pictures differ between two runs";
}

// Points of a sweep share programs, level and g-buffer where they can: what each gives is what it gives
// alone.
TEST(Run, PointsOfASweepGiveWhatTheyGiveAlone) {
  Folder folder;
  const json scenes = {"plane", "canyon"}, sizes = {{48, 27}, {40, 30}}, spots = {0.0, 0.5},
             counts = {40, 60};
  const json sweep = {
      {"scene", scenes}, {"resolution", sizes}, {"lights.spot_fraction", spots}, {"lights.count", counts}};
  // No heat maps: their scale is that of all cases of a run.
  const json pictures = {{"images", {0, 1}}, {"heatmaps", json::array()}};
  const auto run = [&](const std::string& name, const json& changes) {
    json all = changes;
    all["outputs"] = pictures;
    const std::filesystem::path out = folder / name;
    const Outcome outcome = manylights(
        {"run", write_config(folder, small_config(all), name + ".json"), "--out", out.string(), "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    // By what a case is, its counters and hashes of its pictures.
    std::map<std::string, std::pair<json, std::vector<size_t>>> cases;
    const json result = valid_result(out);
    for (const json& item : result["cases"]) {
      std::vector<size_t> files;
      for (const json& file : item["files"]["images"])
        files.push_back(std::hash<std::string>()(text_of(out / file.get<std::string>())));
      const json what = {item["scene"], item["resolution"], item["lights"], item["effects"],
                         item["algorithm"]};
      cases[what.dump()] = {item["counters"], files};
    }
    return cases;
  };
  const auto swept = run("swept", {{"sweep", sweep}});
  EXPECT_EQ(swept.size(), 32u);
  size_t compared = 0;
  for (const json& scene : scenes)
    for (const json& size : sizes)
      for (const json& spot : spots) {
        // One of the two counts, so that the second point of a kept frame is the one that is compared.
        const json point = {{"scene", {scene}},
                            {"resolution", {size}},
                            {"lights.spot_fraction", {spot}},
                            {"lights.count", {60}}};
        const auto alone = run("alone" + std::to_string(compared), {{"sweep", point}});
        for (const auto& [what, given] : alone) {
          ASSERT_TRUE(swept.contains(what)) << what;
          EXPECT_EQ(swept.at(what), given) << what;
          EXPECT_FALSE(given.second.empty());
          ++compared;
        }
      }
  EXPECT_EQ(compared, 16u);
}

TEST(Run, SharesAndFiltersCoverAllCasesOnce) {
  Folder folder;
  const std::string config =
      write_config(folder, small_config({{"sweep", {{"lights.count", {10, 20, 30}}}}}));
  std::set<std::string> all;
  size_t cases = 0;
  for (const char* shard : {"1/2", "2/2"}) {
    const std::filesystem::path out = folder / ("shard" + std::string(1, shard[0]));
    Outcome outcome = manylights({"run", config, "--out", out.string(), "--shard", shard, "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    json result = valid_result(out);
    cases += result["cases"].size();
    all.merge(ids_of(result));
  }
  EXPECT_EQ(cases, 6u);
  EXPECT_EQ(all.size(), 6u);
  Outcome filtered = manylights(
      {"run", config, "--out", (folder / "some").string(), "--filter", "20.*clustered", "--quiet"});
  ASSERT_EQ(filtered.code, 0) << filtered.error;
  std::set<std::string> some = ids_of(valid_result(folder / "some"));
  ASSERT_EQ(some.size(), 1u);
  EXPECT_TRUE(all.contains(*some.begin()));

  Outcome dry = manylights({"run", config, "--out", (folder / "dry").string(), "--dry-run"});
  EXPECT_EQ(dry.code, 0);
  for (const std::string& id : all) EXPECT_NE(dry.out.find(id), std::string::npos) << id;
  EXPECT_FALSE(std::filesystem::exists(folder / "dry"));
}

// A run of two setups with so many laps that it can be stopped between them, and what stops it: the result on
// the disk has a case whose first lap is done.
json long_config() {
  return small_config({{"sweep", {{"lights.count", {20, 30}}}},
                       {"measure", {{"warmup", 0}, {"repeats", 60}}},
                       {"resolution", {160, 90}}});
}

std::function<int()> once_measured(const std::filesystem::path& result, size_t cases, int signal_number) {
  return [=]() -> int {
    if (!std::filesystem::exists(result)) return 0;
    json document = json::parse(text_of(result), nullptr, false);
    if (document.is_discarded() || document["cases"].size() < cases) return 0;
    return document["cases"].back()["repeats_done"] >= 1 ? signal_number : 0;
  };
}

ProcessOptions stop(std::function<int()> watch) {
  ProcessOptions options;
  options.watch = std::move(watch);
  return options;
}

ProcessOptions in_folder(const std::filesystem::path& folder) {
  ProcessOptions options;
  options.folder = folder;
  return options;
}

void expect_resumed(const Folder& folder, const std::string& config) {
  json before = valid_result(folder / "out");
  EXPECT_EQ(before["complete"], false);
  ASSERT_FALSE(before["cases"].empty());
  std::map<std::string, json> finished;
  for (const json& item : before["cases"])
    if (item["repeats_done"] == 60) finished[item["id"]] = item;
  Outcome outcome = manylights({"run", config, "--out", (folder / "out").string(), "--resume", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  json after = valid_result(folder / "out");
  EXPECT_EQ(after["complete"], true);
  EXPECT_EQ(ids_of(after).size(), 4u);
  EXPECT_EQ(after["cases"].size(), 4u);
  for (const json& item : after["cases"]) {
    EXPECT_EQ(item["repeats_done"], 60);
    auto kept = finished.find(item["id"]);
    EXPECT_TRUE(kept == finished.end() || item == kept->second) << "a finished case was measured again";
  }
  EXPECT_FALSE(finished.empty());
}

TEST(Run, KilledInTheMiddleCanBeResumed) {
  Folder folder;
  const std::string config = write_config(folder, long_config());
  // Killed in the second setup: the first one's two cases are done.
  Outcome outcome = manylights({"run", config, "--out", (folder / "out").string(), "--quiet"},
                               stop(once_measured(folder / "out" / "result.json", 3, SIGKILL)));
  ASSERT_EQ(outcome.signal, SIGKILL);
  expect_resumed(folder, config);
  // Another configuration's result is not resumed.
  const std::string other = write_config(folder, small_config(), "other.json");
  expect_error(manylights({"run", other, "--out", (folder / "out").string(), "--resume"}), 2,
               {"another configuration"});
  EXPECT_EQ(valid_result(folder / "out")["complete"], true);
}

TEST(Run, TheSecondOfTwoRunsIntoOneFolderStopsAtOnce) {
  Folder folder;
  const std::string config = write_config(folder, long_config()), out = (folder / "out").string();
  // While the first one goes on, a second is tried; then the first is stopped.
  const std::function<int()> measured = once_measured(folder / "out" / "result.json", 1, SIGTERM);
  Outcome second;
  Outcome first = manylights({"run", config, "--out", out, "--quiet"}, stop([&]() -> int {
                               const int signal_number = measured();
                               if (signal_number)
                                 second = manylights({"run", config, "--out", out, "--force"});
                               return signal_number;
                             }));
  expect_error(second, 3, {out, "another run"});
  EXPECT_EQ(first.code, 4) << first.error;
  EXPECT_EQ(manylights({"run", config, "--out", out, "--quiet", "--resume"}).code, 0);
  EXPECT_EQ(valid_result(folder / "out")["complete"], true);
}

TEST(Run, AResultIsReplacedOnlyWhenToldTo) {
  Folder folder;
  const std::string config = write_config(folder, small_config()), out = (folder / "out").string();
  const std::string other = write_config(folder, small_config({{"lights", {{"count", 7}}}}), "other.json");
  ASSERT_EQ(manylights({"run", config, "--out", out, "--quiet"}).code, 0);
  const std::string whole = text_of(folder / "out" / "result.json");
  for (const std::string& again : {config, other})
    expect_error(manylights({"run", again, "--out", out, "--quiet"}), 2,
                 {out, "--resume", "--force", "--out"});
  expect_error(manylights({"run", config, "--out", out, "--resume", "--force"}), 2, {"--force"});
  EXPECT_EQ(text_of(folder / "out" / "result.json"), whole);
  Outcome forced = manylights({"run", other, "--out", out, "--quiet", "--force"});
  EXPECT_EQ(forced.code, 0) << forced.error;
  EXPECT_EQ(valid_result(folder / "out")["cases"][0]["lights"], 7);
  // Nothing but what a run writes stays behind.
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "run.lock"));
  // Two configurations of one name are told before the first is measured.
  expect_error(manylights({"run", config, other, "--out", (folder / "both").string()}), 2, {"small"});
  EXPECT_FALSE(std::filesystem::exists(folder / "both"));
}

TEST(Run, ADryRunReadsWhatItWouldRun) {
  Folder folder;
  const std::string config = write_config(folder, small_config());
  const std::string level = (folder / "missing.glb").string();
  expect_error(manylights({"run", config, "--dry-run", "--set", "scene.gltf=" + level}), 2,
               {level, "no such file"});
  expect_error(manylights({"run", config, "--dry-run", "--set", "camera.path=no_such_path"}), 2,
               {"no_such_path"});
}

TEST(Run, InterruptedRunKeepsWhatWasMeasured) {
  for (int number : {SIGINT, SIGTERM}) {
    Folder folder;
    const std::string config = write_config(folder, long_config());
    Outcome outcome = manylights({"run", config, "--out", (folder / "out").string(), "--quiet"},
                                 stop(once_measured(folder / "out" / "result.json", 3, number)));
    expect_error(outcome, 4, {"interrupted", "kept"});
    EXPECT_EQ(valid_result(folder / "out")["complete"], false);
    if (number == SIGINT) expect_resumed(folder, config);
  }
}

TEST(Run, DoesNotDependOnTheWorkingDirectory) {
  Folder folder;
  write_config(folder, small_config());
  Outcome outcome = manylights({"run", "config.json", "--out", "here", "--quiet"}, in_folder(folder.path()));
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(valid_result(folder / "here")["complete"], true);
  // Shipped configurations are found from anywhere.
  Outcome dry = manylights({"run", "quick", "--dry-run"}, in_folder("/"));
  EXPECT_EQ(dry.code, 0) << dry.error;
  EXPECT_NE(dry.out.find("canyon-8192"), std::string::npos) << dry.out;
}

}  // namespace
}  // namespace ml::test
