// What a level brings and does not get is said by run, render and verify alike, and stands in the result.
#include <algorithm>

#include "harness/output/result.h"
#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

// A triangle in front of a camera, in a blended material, and five lights: three that shine, one dark, one
// with a cone that is none. Positions are 0,0,0, 1,0,0, 0,1,0 as floats.
json level() {
  json document = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "point", "intensity": 5, "range": 9}, {"type": "point", "intensity": 0, "range": 9},
      {"type": "spot", "intensity": 5, "range": 9, "spot": {"innerConeAngle": 0.9, "outerConeAngle": 0.5}}]}},
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}],
    "materials": [{"alphaMode": "BLEND"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "buffers": [{"byteLength": 36,
      "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 2]}]})");
  for (int light : {0, 0, 0, 1, 2})
    document["nodes"].push_back(
        {{"translation", {0.5, 0.5, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  for (size_t node = 0; node < document["nodes"].size(); ++node)
    document["scenes"][0]["nodes"].push_back(node);
  return document;
}

// Of the level in `file`, its own lights.
std::string config_of(const Folder& folder, const std::string& file, json lights = json::object()) {
  lights["placement"] = "gltf";
  return write_config(folder,
                      small_config({{"scene", {{"gltf", (folder / file).string()}}}, {"lights", lights}}));
}

struct Said {
  Outcome run, render, verify;
};

Said say(const Folder& folder, const std::string& config) {
  return {manylights({"run", config, "--out", (folder / "out").string()}),
          manylights({"render", config, "--frame", "0", "--out", (folder / "frame.png").string()}),
          manylights({"verify", config})};
}

TEST(Bookkeeping, OfLightsAndNotesStandsInEveryCommandAndInTheResult) {
  Folder folder;
  write_text(folder / "level.gltf", level().dump());
  const Said said = say(folder, config_of(folder, "level.gltf"));
  for (const Outcome& outcome : {said.run, said.render, said.verify}) {
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.error;
    for (const char* part : {"5 in the file", "3 used", "1 dark", "1 rejected", "blend"})
      EXPECT_NE(outcome.error.find(part), std::string::npos) << part << " in " << outcome.error;
    EXPECT_EQ(outcome.error.find("no surface"), std::string::npos) << outcome.error;
  }
  const json result = valid_result(folder / "out");
  for (const json& one : result["cases"]) {
    EXPECT_EQ(one["lights"], 3);
    EXPECT_EQ(one["light_account"],
              (json{{"of_file", true}, {"total", 5}, {"used", 3}, {"dark", 1}, {"left_out", 0}}));
    EXPECT_EQ(one["rejected_lights"].size(), 1u) << one["rejected_lights"];
    ASSERT_FALSE(one["notes"].empty());
    EXPECT_EQ(one["frames_without_surface"], 0);
    EXPECT_EQ(one["invalid"], false);
  }
  // A case that is read back is the same.
  const CaseResult back = case_from_json(result["cases"][0]);
  EXPECT_EQ(back.light_account.dark, 1u);
  EXPECT_EQ(back.notes.size(), result["cases"][0]["notes"].size());
}

TEST(Bookkeeping, StandsInTheResultOfAQuietRun) {
  Folder folder;
  write_text(folder / "level.gltf", level().dump());
  const std::string config = config_of(folder, "level.gltf", {{"count", 2}});
  const Outcome outcome = manylights({"run", config, "--out", (folder / "out").string(), "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(outcome.error.empty()) << outcome.error;
  const json one = valid_result(folder / "out")["cases"][0];
  EXPECT_EQ(one["light_account"]["left_out"], 3) << one["light_account"];
  EXPECT_FALSE(one["notes"].empty());
}

TEST(Bookkeeping, AFrameThatSeesNothingIsSaidAndNothingElseIsAnError) {
  Folder folder;
  json away = level();
  away["nodes"][1]["rotation"] = {0, 1, 0, 0};
  write_text(folder / "away.gltf", away.dump());
  const std::string config = config_of(folder, "away.gltf");
  const Said said = say(folder, config);
  expect_error(said.run, 2, {"away.gltf", "no surface is seen in 2 of 2 frames"});
  expect_error(said.render, 2, {"away.gltf", "no surface is seen in 1 of 1 frame"});
  EXPECT_EQ(said.verify.code, 2);
  EXPECT_NE(said.verify.error.find("no surface is seen in 2 of 2 frames"), std::string::npos)
      << said.verify.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "result.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frame.png"));

  // A path whose first frame looks away.
  const json keys = {{{"time", 0}, {"position", {0.3, 0.3, 2}}, {"target", {0.3, 0.3, 9}}},
                     {{"time", 1}, {"position", {0.3, 0.3, 2}}, {"target", {0.3, 0.3, 0}}}};
  const std::string turning =
      write_config(folder,
                   small_config({{"scene", {{"gltf", (folder / "away.gltf").string()}}},
                                 {"lights", {{"placement", "gltf"}}},
                                 {"camera", {{"frames", 2}, {"keyframes", keys}}}}),
                   "turning.json");
  const Outcome run = manylights({"run", turning, "--out", (folder / "out").string()});
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_NE(run.error.find("no surface is seen in 1 of 2 frames"), std::string::npos) << run.error;
  EXPECT_EQ(valid_result(folder / "out")["cases"][0]["frames_without_surface"], 1);
}

}  // namespace
}  // namespace ml::test
