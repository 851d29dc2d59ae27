// What a configuration means, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "bad_documents.h"
#include "harness/base/error.h"
#include "harness/config/config.h"

namespace ml {
namespace {

using nlohmann::json;

Config parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_config_text(text, "test.json", "/levels", overrides);
}

// The message of the UsageError, which must be one line and begin with `source`.
std::string refusal(const std::string& text, const std::string& source = "test.json",
                    const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const UsageError& error) {
    std::string what = error.what();
    EXPECT_TRUE(what.starts_with(source + ": ")) << what;
    EXPECT_EQ(what.find('\n'), what.npos) << what;
    return what;
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

#define EXPECT_SAYS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << text

TEST(ConfigReading, EmptyObjectIsTheDefaults) {
  Config config = parse("{}");
  EXPECT_EQ(config.name, "test");
  ASSERT_EQ(config.setups.size(), 1u);
  const ml::Setup& setup = config.setups[0];
  EXPECT_EQ(setup.scene.procedural, "canyon");
  EXPECT_EQ(setup.scene_label, "canyon");
  EXPECT_EQ(setup.lights.count, 8192u);
  EXPECT_EQ(setup.width, 960u);
  EXPECT_EQ(setup.height, 540u);
  EXPECT_EQ(setup.camera.path, "default");
  EXPECT_EQ(config.measure.repeats, 3u);
}

TEST(ConfigReading, AllIsEveryAlgorithmButTheReferenceOnes) {
  Config config = parse(R"({"algorithms": "all"})");
  std::vector<std::string> names, expected;
  for (const AlgorithmSpec& spec : config.setups[0].algorithms) names.push_back(spec.name);
  for (const AlgorithmEntry& entry : algorithm_registry()) {
    if (!entry.info.reference_only) expected.push_back(entry.info.name);
  }
  EXPECT_EQ(names, expected);
  EXPECT_EQ(std::count(names.begin(), names.end(), "brute_force"), 0);
  EXPECT_EQ(std::count(names.begin(), names.end(), "clustered"), 1);
}

TEST(ConfigReading, EveryKeyReachesItsField) {
  Config config = parse(R"({
    "name": "every", "description": "x",
    "scene": {"gltf": "sub/../a.glb", "scene": 2, "seed": 7, "offset": [1, -2.5, 1e6]},
    "lights": {"placement": "area", "count": 9, "sizing": "fixed_size", "base_size": 0.25, "radius_ratio": 24, "radius": 3,
               "height": 2, "spot_fraction": 0.5, "capsule_fraction": 0.125, "wedge_fraction": 0.25,
               "box_fraction": 0.0625, "probe_fraction": 0.375, "intensity": 2, "seed": 4, "animate": "spawn"},
    "camera": {"frames": 3, "keyframes": [{"time": 0, "position": [1, 2, 3], "target": [4, 5, 6]},
                                          {"time": 2.5, "position": [7, 8, 9], "target": [0, 0, 1]}]},
    "resolution": [17, 1],
    "algorithms": [{"name": "clustered", "tile": 32, "zmin": 2, "refinement": true, "light_data": "duplicated"}, "brute_force"],
    "measure": {"warmup": 0, "repeats": 5, "threads": 2, "seed": 9, "mode": "whole"},
    "outputs": {"heatmaps": [2, 0], "images": [1], "trace": false},
    "effects": {"spots": "off", "capsules": "off", "wedges": "auto", "boxes": "off", "probes": "off", "specular": "auto", "alpha_mask": "off", "forward": "off", "material_detail": "off", "emission": "off"},
    "shading": {"targets": "split", "shadow_maps": 4, "shadow_map_size": 512, "list_queue": "compute", "light_fetch": "storage", "test_ahead": true}})");
  EXPECT_EQ(config.name, "every");
  const ml::Setup& setup = config.setups.at(0);
  EXPECT_EQ(setup.scene.gltf, "/levels/a.glb");
  EXPECT_EQ(setup.scene.procedural, "");
  EXPECT_EQ(setup.scene.gltf_scene, 2);
  EXPECT_EQ(setup.scene.seed, 7u);
  EXPECT_EQ(setup.scene.offset, glm::dvec3(1, -2.5, 1e6));
  EXPECT_EQ(setup.scene_label, "a");
  const LightSpec& lights = setup.lights;
  EXPECT_EQ(lights.placement, Placement::area);
  EXPECT_EQ(lights.count, 9u);
  EXPECT_EQ(lights.sizing, Sizing::fixed_size);
  EXPECT_EQ(lights.base_size, 0.25f);
  EXPECT_EQ(lights.radius_ratio, 24);
  EXPECT_EQ(lights.radius, 3);
  EXPECT_EQ(lights.height, 2);
  EXPECT_EQ(lights.spot_fraction, 0.5f);
  EXPECT_EQ(lights.capsule_fraction, 0.125f);
  EXPECT_EQ(lights.wedge_fraction, 0.25f);
  EXPECT_EQ(lights.box_fraction, 0.0625f);
  EXPECT_EQ(lights.probe_fraction, 0.375f);
  EXPECT_EQ(lights.intensity, 2);
  EXPECT_EQ(lights.seed, 4u);
  EXPECT_EQ(lights.script, LightScript::spawn);
  EXPECT_EQ(setup.camera.frames, 3u);
  ASSERT_EQ(setup.camera.keyframes.size(), 2u);
  EXPECT_EQ(setup.camera.keyframes[1].time, 2.5);
  EXPECT_EQ(setup.camera.keyframes[1].position, glm::dvec3(7, 8, 9));
  EXPECT_EQ(setup.camera.keyframes[0].target, glm::dvec3(4, 5, 6));
  EXPECT_EQ(setup.width, 17u);
  EXPECT_EQ(setup.height, 1u);
  ASSERT_EQ(setup.algorithms.size(), 2u);
  EXPECT_EQ(setup.algorithms[0].parameters.integer("tile"), 32);
  EXPECT_EQ(setup.algorithms[0].parameters.real("zmin"), 2);
  EXPECT_TRUE(setup.algorithms[0].parameters.boolean("refinement"));
  EXPECT_EQ(setup.algorithms[0].parameters.choice("light_data"), "duplicated");
  EXPECT_EQ(setup.algorithms[1].name, "brute_force");
  EXPECT_EQ(config.measure.warmup, 0u);
  EXPECT_EQ(config.measure.repeats, 5u);
  EXPECT_EQ(config.measure.threads, 2u);
  EXPECT_EQ(config.measure.seed, 9u);
  EXPECT_EQ(config.measure.mode, TimingMode::whole);
  EXPECT_EQ(config.outputs.heatmaps, (std::vector<uint32_t>{2, 0}));
  EXPECT_EQ(config.outputs.images, (std::vector<uint32_t>{1}));
  EXPECT_FALSE(config.outputs.trace);
  EXPECT_FALSE(setup.effects.spots);
  EXPECT_FALSE(setup.effects.capsules);
  EXPECT_TRUE(setup.effects.wedges);
  EXPECT_FALSE(setup.effects.boxes);
  EXPECT_TRUE(setup.effects.specular);
  EXPECT_FALSE(setup.effects.alpha_mask);
  EXPECT_FALSE(setup.effects.forward);
  EXPECT_FALSE(setup.effects.material_detail);
  EXPECT_FALSE(setup.effects.emission);
  EXPECT_FALSE(setup.effects.probes);
  EXPECT_EQ(setup.shading.targets, ShadingTargets::split);
  EXPECT_EQ(setup.shading.shadow_maps, 4u);
  EXPECT_EQ(setup.shading.shadow_map_size, 512u);
  EXPECT_EQ(setup.shading.list_queue, ListQueue::compute);
  EXPECT_EQ(setup.shading.light_fetch, LightFetch::storage);
  EXPECT_TRUE(setup.shading.test_ahead);
}

TEST(ConfigReading, SharesOfTheShapesAddUpToOneAtMost) {
  EXPECT_NO_THROW(parse(R"({"lights": {"spot_fraction": 0.1, "capsule_fraction": 0.2, "wedge_fraction": 0.3,
                                       "box_fraction": 0.4}})"));
  // At one point of a sweep, too.
  auto message = [](const char* text) -> std::string {
    try {
      parse(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const char* text :
       {R"({"lights": {"spot_fraction": 0.5, "box_fraction": 0.75}})",
        R"({"lights": {"spot_fraction": 0.5}, "sweep": {"lights.box_fraction": [0, 0.75]}})"}) {
    const std::string found = message(text);
    EXPECT_NE(
        found.find("$.lights: spot_fraction, capsule_fraction, wedge_fraction and box_fraction add up to "
                   "1.25, expected at most 1"),
        found.npos)
        << found;
    EXPECT_EQ(found.find('\n'), found.npos);
  }
}

TEST(ConfigReading, ParameterListsMakeOneEntryPerValue) {
  Config config =
      parse(R"({"algorithms": [{"name": "clustered", "tile": [16, 24, 32], "slices": [8, 16]}, "ideal"]})");
  const auto& algorithms = config.setups[0].algorithms;
  ASSERT_EQ(algorithms.size(), 7u);
  std::vector<std::pair<int64_t, int64_t>> found;
  for (size_t i = 0; i < 6; ++i) {
    found.emplace_back(algorithms[i].parameters.integer("tile"), algorithms[i].parameters.integer("slices"));
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::pair<int64_t, int64_t>>{
                       {16, 8}, {16, 16}, {24, 8}, {24, 16}, {32, 8}, {32, 16}}));
  EXPECT_EQ(algorithms[6].name, "ideal");
}

TEST(ConfigReading, SweepIsTheProductAndZipGoesSideBySide) {
  Config config = parse(R"({"sweep": {"lights.count": [1, 2, 3], "resolution": [[8, 4], [16, 8]]},
                            "zip": {"lights.seed": [5, 6], "scene": ["plane", "canyon"]}})");
  std::set<std::tuple<uint32_t, uint32_t, uint32_t, std::string>> points;
  for (const ml::Setup& setup : config.setups) {
    points.insert({setup.lights.count, setup.width, setup.lights.seed, setup.scene_label});
    EXPECT_EQ(setup.height * 2, setup.width);
    EXPECT_EQ(setup.scene_label, setup.lights.seed == 5 ? "plane" : "canyon");
    EXPECT_EQ(setup.scene.procedural, setup.scene_label);
  }
  EXPECT_EQ(config.setups.size(), 12u);
  EXPECT_EQ(points.size(), 12u);
}

TEST(ConfigReading, SweptParametersGoToEveryAlgorithmThatHasThem) {
  Config config = parse(R"({"algorithms": ["ideal", "clustered", {"name": "clustered", "slices": 4}],
                            "sweep": {"algorithms.tile": [16, 32], "algorithms.2.zmin": [1, 2]}})");
  ASSERT_EQ(config.setups.size(), 4u);
  for (const ml::Setup& setup : config.setups) {
    EXPECT_EQ(setup.algorithms[1].parameters.integer("tile"), setup.algorithms[2].parameters.integer("tile"));
    EXPECT_EQ(setup.algorithms[1].parameters.real("zmin"), 5);
    EXPECT_LE(setup.algorithms[2].parameters.real("zmin"), 2);
  }
}

TEST(ConfigReading, RefusesWhatIsImpossible) {
  for (const BadDocument& bad : bad_documents()) {
    std::string what = refusal(bad.text);
    EXPECT_TRUE(what.starts_with(std::string("test.json: ") + bad.path)) << bad.text << "\n" << what;
    EXPECT_SAYS(what, bad.why) << bad.text;
  }
}

TEST(ConfigReading, RefusesNumbersThatTextCannotHold) {
  for (double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const char* key : {"radius", "intensity", "count"}) {
      json document{{"lights", {{key, value}}}};
      EXPECT_THROW(parse_config(document, "x", ""), UsageError) << key;
    }
    json document{{"algorithms", json::array({{{"name", "clustered"}, {"zmin", value}}})}};
    EXPECT_THROW(parse_config(document, "x", ""), UsageError);
  }
}

TEST(ConfigReading, RefusesMoreThanTenThousandCases) {
  json values = json::array();
  for (int i = 0; i < 100; ++i) values.push_back(i);
  json document{{"algorithms", {"ideal"}}, {"sweep", {{"lights.count", values}, {"lights.seed", values}}}};
  EXPECT_EQ(parse_config(document, "x", "").setups.size(), 10000u);
  document["algorithms"] = {"ideal", "clustered"};
  EXPECT_THROW(parse_config(document, "x", ""), UsageError);
  document["algorithms"] = {"ideal"};
  document["sweep"]["measure"] = values;
  EXPECT_THROW(parse_config(document, "x", ""), UsageError);
  document["sweep"].erase("measure");
  document["sweep"]["scene.seed"] = values;
  document["sweep"]["measure.seed"] = values;
  EXPECT_THROW(parse_config(document, "x", ""), UsageError);
  json tiles = json::array();
  for (int i = 4; i < 204; ++i) tiles.push_back(i);
  json wide{{"algorithms", {{{"name", "clustered"}, {"tile", tiles}, {"slices", values}}}}};
  wide["algorithms"][0]["slices"].erase(0);
  EXPECT_THROW(parse_config(wide, "x", ""), UsageError);
}

TEST(ConfigReading, RefusesMoreLightsThanAnAlgorithmTakes) {
  for (const AlgorithmEntry& entry : algorithm_registry()) {
    if (entry.info.max_lights == 0 || entry.info.max_lights >= 1048576) continue;
    json document{{"algorithms", {entry.info.name}}, {"lights", {{"count", entry.info.max_lights}}}};
    EXPECT_NO_THROW(parse_config(document, "x", ""));
    document["lights"]["count"] = entry.info.max_lights + 1;
    EXPECT_THROW(parse_config(document, "x", ""), UsageError);
    document["lights"]["placement"] = "gltf";  // the file's own lights, as many as they are
    EXPECT_NO_THROW(parse_config(document, "x", ""));
  }
}

TEST(ConfigReading, TheAlgorithmsOwnCheckIsAsked) {
  std::string what = refusal(R"({"algorithms": ["ideal", {"name": "clustered", "zmin": 10, "zmax": 5}]})");
  EXPECT_SAYS(what, "$.algorithms[1]");
}

TEST(ConfigReading, NamesComeFromTheFile) {
  EXPECT_EQ(parse_config(json::object(), "/a/b/my file (2).json", "").name, "my-file--2-");
  EXPECT_EQ(parse_config(json::object(), "", "").name, "config");
  EXPECT_EQ(parse_config(json::object(), "...", "").name, "config");
}

TEST(ConfigReading, TheSceneBringsThePlacementThatIsNotNamed) {
  auto placement = [](const Config& config) { return config.resolved["lights"]["placement"]; };
  EXPECT_EQ(placement(parse("{}")), "volume");
  EXPECT_EQ(placement(parse(R"({"scene": "citadel"})")), "triangle");
  EXPECT_EQ(placement(parse("{}", {"scene=plane"})), "area");
  EXPECT_EQ(placement(parse(R"({"scene": {"gltf": "level.glb"}})")), "volume");
  Config grove = parse(R"({"scene": "grove"})");
  EXPECT_EQ(placement(grove), "area");
  EXPECT_EQ(grove.resolved["lights"]["radius_ratio"], 24);
  EXPECT_EQ(grove.setups[0].lights.placement, Placement::area);
  EXPECT_EQ(grove.setups[0].lights.radius_ratio, 24);
  EXPECT_EQ(placement(parse(R"({"scene": "museum"})")), "stage");
  // The clumps' ratio of radii depends on their number.
  Config arena = parse(R"({"scene": "arena"})");
  EXPECT_EQ(placement(arena), "clumps");
  EXPECT_FALSE(arena.resolved["lights"].contains("radius_ratio"));
  Config named = parse(R"({"scene": "grove", "lights": {"placement": "volume", "radius_ratio": 2}})");
  EXPECT_EQ(placement(named), "volume");
  EXPECT_EQ(named.setups[0].lights.placement, Placement::volume);
  EXPECT_EQ(named.setups[0].lights.radius_ratio, 2);
}

TEST(ConfigReading, SweptScenesBringTheirOwnPlacements) {
  Config config = parse(R"({"sweep": {"scene": ["canyon", "citadel", "grove"]}})");
  ASSERT_EQ(config.setups.size(), 3u);
  EXPECT_EQ(config.setups[0].lights.placement, Placement::volume);
  EXPECT_EQ(config.setups[1].lights.placement, Placement::triangle);
  EXPECT_EQ(config.setups[2].lights.placement, Placement::area);
  EXPECT_EQ(config.setups[2].lights.radius_ratio, 24);
  // No single value would be true.
  EXPECT_FALSE(config.resolved["lights"].contains("placement"));
  EXPECT_EQ(expand_cases(config)[1].id.find("placement"), std::string::npos);

  config = parse(R"({"lights": {"placement": "area"}, "sweep": {"scene": ["canyon", "citadel"]}})");
  EXPECT_EQ(config.setups[1].lights.placement, Placement::area);
  EXPECT_EQ(config.resolved["lights"]["placement"], "area");
  config = parse(R"({"scene": "citadel", "sweep": {"lights.placement": ["triangle", "area"]}})");
  EXPECT_EQ(config.resolved["lights"]["placement"], "triangle");
  EXPECT_NE(expand_cases(config)[0].id.find("placement-triangle"), std::string::npos);
}

TEST(ConfigOverrides, SetAnyKey) {
  Config config =
      parse(R"({"algorithms": ["clustered", "ideal", {"name": "clustered", "slices": 4}]})",
            {"lights.count=5", "scene=plane", "resolution=[8, 9]", "algorithms.tile=32",
             "algorithms.2.zmin=1", "algorithms[0].slices=3", "lights={\"seed\": 2}", "name=other",
             "measure.mode=whole", "outputs.images=[1]", "camera.frames=2", "effects.spots=off"});
  const ml::Setup& setup = config.setups[0];
  EXPECT_EQ(setup.lights.count, 5u);
  EXPECT_EQ(setup.lights.seed, 2u);
  EXPECT_EQ(setup.scene_label, "plane");
  EXPECT_EQ(setup.width, 8u);
  EXPECT_EQ(setup.algorithms[0].parameters.integer("tile"), 32);
  EXPECT_EQ(setup.algorithms[2].parameters.integer("tile"), 32);
  EXPECT_EQ(setup.algorithms[0].parameters.real("zmin"), 5);
  EXPECT_EQ(setup.algorithms[2].parameters.real("zmin"), 1);
  EXPECT_EQ(setup.algorithms[0].parameters.integer("slices"), 3);
  EXPECT_EQ(setup.algorithms[2].parameters.integer("slices"), 4);
  EXPECT_EQ(config.name, "other");
  EXPECT_EQ(config.measure.mode, TimingMode::whole);
  EXPECT_EQ(config.outputs.images, (std::vector<uint32_t>{1}));
  EXPECT_FALSE(setup.effects.spots);
}

TEST(ConfigOverrides, SetAlgorithmsByName) {
  Config config = parse(R"({"algorithms": "all"})", {"algorithms.clustered.tile=48"});
  for (const AlgorithmSpec& spec : config.setups[0].algorithms) {
    if (spec.name == "clustered") {
      EXPECT_EQ(spec.parameters.integer("tile"), 48);
    } else {
      auto tile = spec.parameters.values().find("tile");
      if (tile != spec.parameters.values().end()) {
        EXPECT_NE(std::get<int64_t>(tile->second), 48);
      }
    }
  }
}

TEST(ConfigOverrides, ASetKeyIsNoLongerSwept) {
  const std::string text = R"({"sweep": {"lights.count": [1, 2], "lights.seed": [1, 2, 3]}})";
  EXPECT_EQ(parse(text, {"lights.count=7"}).setups.size(), 3u);
  EXPECT_EQ(parse(text, {"lights.count=7"}).setups[2].lights.count, 7u);
  EXPECT_EQ(parse(text, {"lights={\"seed\": 9}"}).setups.size(), 2u);
  EXPECT_EQ(parse(text, {"sweep={}"}).setups.size(), 1u);
  EXPECT_EQ(parse(text, {"sweep.lights.count=[4,5,6]"}).setups.size(), 9u);
  EXPECT_EQ(parse(text, {"zip.lights.count=[4,5,6]", "zip.scene.seed=[1,2,3]"}).setups.size(), 9u);
  EXPECT_SAYS(refusal(R"({"sweep": {"scene": ["plane", "canyon"]}})", "--set", {"scene.seed=3"}),
              "sweeps 'scene'");
}

TEST(ConfigOverrides, ErrorsNameTheOverride) {
  EXPECT_SAYS(refusal("{}", "--set", {"lights.cuont=5"}),
              "$.lights.cuont: unknown key, did you mean 'count'?");
  EXPECT_SAYS(refusal("{}", "--set", {"light.count=5"}), "did you mean 'lights.count'?");
  EXPECT_SAYS(refusal("{}", "--set", {"count=5"}), "did you mean 'lights.count'?");
  EXPECT_SAYS(refusal("{}", "--set", {"lights.count=-5"}), "$.lights.count: expected an integer");
  EXPECT_SAYS(refusal("{}", "--set", {"lights.count=many"}), "found \"many\"");
  EXPECT_SAYS(refusal("{}", "--set", {"algorithms.tiel=16"}), "did you mean 'tile'?");
  EXPECT_SAYS(refusal("{}", "--set", {"algorithms.99.tile=16"}), "at '99'");
  EXPECT_SAYS(refusal("{}", "--set", {"algorithms.tile=0"}), "$.algorithms.tile: expected an integer from 4");
  EXPECT_SAYS(refusal("{}", "--set", {"sweep.lights.cuont=[1]"}), "did you mean 'count'?");
  EXPECT_SAYS(refusal("{}", "--set", {"lights.count"}), "expected KEY=VALUE");
  EXPECT_SAYS(refusal("{}", "--set", {"=5"}), "expected KEY=VALUE");
  EXPECT_SAYS(refusal("{}", "--set resolution", {"resolution=[8,"}), "column");
  EXPECT_SAYS(refusal("{}", "--set", {"algorithms.=5"}), "algorithms");
  EXPECT_SAYS(refusal("{}", "--set", {"algorithms[=5"}), "algorithms");
}

TEST(ConfigOverrides, RelativeLevelsStartFromTheWorkingDirectory) {
  Config config = parse("{}", {"scene={\"gltf\": \"a.glb\"}"});
  EXPECT_EQ(config.setups[0].scene.gltf, std::filesystem::current_path() / "a.glb");
  EXPECT_EQ(parse(R"({"scene": {"gltf": "a.glb"}})").setups[0].scene.gltf, "/levels/a.glb");
}

// A count belongs to the placement that it was written beside: a file's lights are cut only by a count that
// was meant for them.
TEST(LightCount, OfAFilesLights) {
  auto takes_all = [](const std::string& text, const std::vector<std::string>& overrides) {
    const Config config = parse(text, overrides);
    EXPECT_EQ(config.setups[0].lights.placement, Placement::gltf);
    return config.setups[0].lights.auto_count;
  };
  const std::string volume = R"({"lights": {"placement": "volume", "count": 512}})",
                    own = R"({"lights": {"placement": "gltf", "count": 512}})";
  EXPECT_TRUE(takes_all(volume, {"lights.placement=gltf"}));
  EXPECT_TRUE(takes_all(volume, {R"(lights={"placement":"gltf"})"}));
  EXPECT_TRUE(takes_all("{}", {"lights.placement=gltf"}));
  EXPECT_TRUE(takes_all(R"({"lights": {"placement": "gltf"}})", {}));
  EXPECT_TRUE(takes_all(own, {"lights.count=auto"}));
  EXPECT_TRUE(takes_all(own, {"lights.placement=gltf"}));
  EXPECT_FALSE(takes_all(own, {}));
  EXPECT_FALSE(takes_all(volume, {"lights.placement=gltf", "lights.count=512"}));
  EXPECT_FALSE(takes_all(volume, {"lights.count=512", "lights.placement=gltf"}));
  EXPECT_FALSE(takes_all(volume, {R"(lights={"placement":"gltf","count":3})"}));
  EXPECT_FALSE(takes_all(R"({"sweep": {"lights.count": [1, 2]}})", {"lights.placement=gltf"}));
  EXPECT_EQ(parse(volume, {"lights.placement=gltf"}).resolved["lights"]["count"], "auto");
  EXPECT_EQ(parse(own).resolved["lights"]["count"], 512);
  EXPECT_EQ(parse("{}").resolved["lights"]["count"], 8192);
  EXPECT_SAYS(refusal(R"({"lights": {"count": "all"}})"),
              "expected an integer from 0 to 1048576 or \"auto\"");
}

}  // namespace
}  // namespace ml
