#include "scenes/description.h"

#include <gtest/gtest.h>

#include "harness/base/error.h"

namespace ml {
namespace {

constexpr const char* kGood = R"({
  "summary": "A hill.", "near": 0.1, "far": 200,
  "lights": {"placement": "area", "radius_ratio": 24, "area_size": 0.5, "animate": "drift"},
  "paths": [
    {"name": "default", "keys": [
      {"time": 0, "position": {"x": 1, "z": 2, "above_ground": 1.7}, "target": [0, 0, 0]},
      {"time": 2.5, "position": [0.1, 3, -7], "target": [1e-3, 0, 0]}]},
    {"name": "above", "keys": [{"time": 0, "position": [0, 40, 0], "target": [0, 0, 0]}]}],
  "wanted": {"hash": "00c0ffee", "triangles": [2, null], "median_depth": {"default": [null, 4]},
             "lights": [{"count": 500, "placement": "volume", "mean": [2, 4]}],
             "numbers": {"trees": [7, 9]}}
})";

// kGood with the first `from` replaced by `to`.
std::string with(const std::string& from, const std::string& to) {
  std::string json = kGood;
  const size_t at = json.find(from);
  EXPECT_NE(at, json.npos) << from;
  return json.replace(at, from.size(), to);
}

std::string refusal(const std::string& json) {
  try {
    read_description("hill", json);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneDescription, IsReadAsItIsWritten) {
  const SceneDescription hill = read_description("hill", kGood);
  EXPECT_EQ(hill.name, "hill");
  EXPECT_EQ(hill.summary, "A hill.");
  EXPECT_EQ(hill.near, 0.1f);
  EXPECT_EQ(hill.far, 200);
  EXPECT_EQ(
      hill.lights,
      (LightDefaults{
          .placement = Placement::area, .radius_ratio = 24, .area_size = 0.5, .script = LightScript::drift}));
  EXPECT_EQ(hill.wanted.hash, 0xc0ffeeu);
  EXPECT_TRUE(hill.wanted.triangles.holds(1e300));
  EXPECT_FALSE(hill.wanted.triangles.holds(1));
  EXPECT_TRUE(hill.wanted.size_x.holds(-5));
  EXPECT_FALSE(hill.wanted.median_depth.at("default").holds(4.1));
  ASSERT_EQ(hill.wanted.lights.size(), 1u);
  EXPECT_EQ(hill.wanted.lights[0].placement, Placement::volume);
  EXPECT_TRUE(hill.wanted.number("trees").holds(9));
  EXPECT_THROW(hill.wanted.number("treees"), UsageError);
}

TEST(SceneDescription, PathsFollowTheGround) {
  const SceneDescription hill = read_description("hill", kGood);
  const std::vector<CameraPath> paths = camera_paths(hill, [](double x, double z) { return 10 * x + z; });
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].name, "default");
  EXPECT_EQ(paths[0].keys[0].position, glm::dvec3(1, 12 + 1.7, 2));
  EXPECT_EQ(paths[0].keys[1].time, 2.5);
  EXPECT_EQ(paths[0].keys[1].position, glm::dvec3(0.1, 3, -7));
  EXPECT_EQ(paths[0].keys[1].target, glm::dvec3(1e-3, 0, 0));
  EXPECT_THROW(camera_paths(hill), std::logic_error);
}

TEST(SceneDescription, SaysWhereItIsWrong) {
  struct Bad {
    std::string json, message;
  };
  const std::string file = "scenes/hill/scene.json: ";
  for (const Bad& bad : {
           Bad{with("\"far\"", "\"fra\""), "$: the key 'far' is missing"},
           Bad{with("\"far\": 200", "\"far\": 200, \"farr\": 1"), "$.farr: unknown key, did you mean 'far'?"},
           Bad{with("200", "0.05"), "$.far: the far plane lies before the near one"},
           Bad{with("\"area\"", "\"aera\""), "$.lights.placement: expected one of"},
           Bad{with("area_size", "area_sise"), "$.lights.area_sise: unknown key, did you mean 'area_size'?"},
           Bad{with("\"drift\"", "\"drfit\""), "$.lights.animate: expected one of"},
           Bad{with("\"default\", \"keys\"", "\"first\", \"keys\""), "$.paths[0].name: expected 'default'"},
           Bad{with("\"above\"", "\"default\""), "$.paths[1].name: there is a path of that name before"},
           Bad{with("\"time\": 2.5", "\"time\": 0"), "$.paths[0].keys[1].time: times of a path increase"},
           Bad{with("[0.1, 3, -7]", "[0.1, 3]"), "$.paths[0].keys[1].position: expected a list of 3"},
           Bad{with("[0.1, 3, -7]", "\"here\""),
               "$.paths[0].keys[1].position: expected [x, y, z] or an object"},
           Bad{with("\"above_ground\": 1.7", "\"above_gruond\": 1.7"),
               "$.paths[0].keys[0].position: the key 'above_ground' is missing"},
           Bad{with("\"target\": [0, 0, 0]", "\"target\": [0, 0, 0], \"roll\": 1"),
               "$.paths[0].keys[0].roll: unknown key"},
           Bad{with("00c0ffee", "00c0ffeg"), "$.wanted.hash: expected 8 hexadecimal digits"},
           Bad{with("[2, null]", "[2]"), "$.wanted.triangles: expected a list of 2"},
           Bad{with("[2, 4]", "[4, 2]"), "$.wanted.lights[0].mean: the range's end lies before its begin"},
           Bad{with("[7, 9]", "[\"7\", 9]"), "$.wanted.numbers.trees[0]: expected a number"},
           Bad{with("\"numbers\"", "\"nunbers\""), "$.wanted.nunbers: unknown key, did you mean 'numbers'?"},
           Bad{with("\"far\": 200,", "\"far\": 200,,"), "line 2, column"},
       }) {
    EXPECT_EQ(refusal(bad.json).find(file + bad.message), 0u) << refusal(bad.json) << "\nfor " << bad.message;
  }
}

}  // namespace
}  // namespace ml
