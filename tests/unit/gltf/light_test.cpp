// Lights of a glTF file.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/lights/set.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

GltfTestFile lit_file(const Json& light, const Json& node) {
  GltfTestFile file = triangle_file();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  Json placed = node;
  placed["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
  file.json["nodes"].push_back(placed);
  return file;
}

TEST(GltfLight, PointWithRange) {
  Scene scene = lit_file({{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 8}, {"range", 3}},
                         {{"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}})
                    .load();
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.shape, LightShape::omni);
  EXPECT_EQ(light.position + scene.origin, dvec3(1, 2, 3));
  EXPECT_EQ(light.intensity, glm::vec3(8, 4, 0));
  EXPECT_EQ(light.radius, 3.0f);  // a node's scale leaves the range alone
}

TEST(GltfLight, SpotPointsAlongItsNode) {
  double h = std::sqrt(0.5);
  Scene scene =
      lit_file(
          {{"type", "spot"}, {"range", 9}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
          {{"rotation", {-h, 0, 0, h}}})
          .load();  // -z turned down
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.shape, LightShape::spot);
  EXPECT_LT(glm::length(light.direction - glm::vec3(0, -1, 0)), 1e-6f);
  EXPECT_EQ(light.inner_angle, 0.25f);
  EXPECT_EQ(light.outer_angle, 0.5f);
  Scene defaults =
      lit_file({{"type", "spot"}, {"range", 9}, {"spot", Json::object()}}, Json::object()).load();
  EXPECT_EQ(defaults.lights[0].inner_angle, 0.0f);
  EXPECT_FLOAT_EQ(defaults.lights[0].outer_angle, 0.78539816f);
}

// The bench's own shapes on a node that is turned, mirrored and scaled unevenly.
Light shaped_light(const Json& own, const char* type, const Json& scale = {-2, 3, 0.5}) {
  double h = std::sqrt(0.5);
  Json light = {{"type", type}, {"range", 9}, {"extras", {{"manylights", own}}}};
  if (std::string(type) == "spot") light["spot"] = {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}};
  // A quarter turn about y: x to -z, -z to -x.
  return lit_file(light, {{"rotation", {0, h, 0, h}}, {"scale", scale}}).load().lights.at(0);
}

TEST(GltfLight, OwnShapesTakeTheirAxesFromTheNodeAndNoScale) {
  Light capsule = shaped_light({{"shape", "capsule"}, {"half_length", 1.5}}, "point");
  EXPECT_EQ(capsule.shape, LightShape::capsule);
  EXPECT_EQ(capsule.half_length, 1.5f);
  EXPECT_EQ(capsule.radius, 9.0f);
  EXPECT_NEAR(std::abs(capsule.side.z), 1, 1e-6);
  Light wedge = shaped_light({{"shape", "wedge"}, {"half_length", 2}}, "spot");
  EXPECT_EQ(wedge.shape, LightShape::wedge);
  EXPECT_NEAR(std::abs(wedge.side.z), 1, 1e-6);
  EXPECT_LT(glm::length(wedge.direction - glm::vec3(-1, 0, 0)), 1e-6f);
  EXPECT_EQ(wedge.inner_angle, 0.25f);
  EXPECT_EQ(wedge.outer_angle, 0.5f);
  Light box = shaped_light({{"shape", "box"}, {"half_extents", {1, 2, 2}}}, "point");
  EXPECT_EQ(box.shape, LightShape::box);
  EXPECT_EQ(box.half_extents, glm::vec3(1, 2, 2));
  EXPECT_EQ(box.radius, 3.0f) << "its own, not the range";
  for (const Light& light : {capsule, wedge, box}) EXPECT_EQ(rejection_reason(light), nullptr);
  Light flat = shaped_light({{"shape", "box"}, {"half_extents", {1, 0, 2}}}, "point");
  EXPECT_STREQ(rejection_reason(flat), "half extent is 0");
}

TEST(GltfLight, OwnShapesThatAreIncompleteAreErrors) {
  auto message = [](const Json& own, const char* type) -> std::string {
    try {
      shaped_light(own, type);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string where = "test.glb: extensions.KHR_lights_punctual.lights[0]";
  EXPECT_EQ(message({{"shape", "capsule"}}, "point"), where + ".extras.manylights: 'half_length' is missing");
  EXPECT_EQ(message({{"shape", "box"}}, "point"), where + ".extras.manylights: 'half_extents' is missing");
  EXPECT_EQ(message({{"shape", "wedge"}, {"half_length", 1}}, "point"),
            where + ".type: is 'point', expected 'spot' for the shape 'wedge'");
  EXPECT_EQ(message({{"shape", "boxx"}}, "point"),
            where + ".extras.manylights.shape: unknown value 'boxx', did you mean 'box'?");
  EXPECT_EQ(message({{"shape", "box"}, {"half_extents", {1, 2}}}, "point"),
            where + ".extras.manylights.half_extents: expected 3 numbers");
}

// Other programs hide a light by scale 0: it is counted, and the level stays.
TEST(GltfLight, UnderScaleZeroItIsRejected) {
  const Json spot = {{"type", "spot"}, {"range", 9}, {"spot", Json::object()}};
  const Json capsule = {{"type", "point"},
                        {"range", 9},
                        {"extras", {{"manylights", {{"shape", "capsule"}, {"half_length", 1}}}}}};
  auto rejected = [](const Json& light, const Json& scale) {
    GltfTestFile file = lit_file(light, {{"scale", scale}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.lights.size() + scene.rejected_lights.size(), 1u);
    return scene.lights.empty() && scene.rejected_lights.at("its node has scale 0") == 1;
  };
  EXPECT_TRUE(rejected(spot, {0, 0, 0}));
  EXPECT_TRUE(rejected({{"type", "point"}, {"range", 9}}, {0, 0, 0}));
  EXPECT_TRUE(rejected(spot, {1, 1, 0}));
  EXPECT_TRUE(rejected(capsule, {0, 1, 1}));
  EXPECT_FALSE(rejected(spot, {0, 1, 1}));
  EXPECT_FALSE(rejected({{"type", "point"}, {"range", 9}}, {1, 0, 1}));
  // The same where a node above has it.
  GltfTestFile file = lit_file(spot, Json::object());
  file.json["nodes"].push_back({{"children", {2}}, {"scale", {0, 0, 0}}});
  file.json["scenes"][0]["nodes"] = {0, 1, 3};
  EXPECT_EQ(file.load().rejected_lights.at("its node has scale 0"), 1u);
}

TEST(GltfLight, WithoutRangeItEndsWhereItIsDim) {
  // 0.01 W/m^2 lie at 10 * sqrt(I) m, in a level of 5.66 m too: its window must not darken what is near.
  Scene dim = lit_file({{"type", "point"}, {"intensity", 0.04}}, Json::object()).load();
  EXPECT_FLOAT_EQ(dim.lights[0].radius, 2.0f);
  Scene bright = lit_file({{"type", "point"}, {"intensity", 1e9}}, Json::object()).load();
  EXPECT_FLOAT_EQ(bright.lights[0].radius, 10 * std::sqrt(1e9f));
  EXPECT_EQ(bright.notes.back(), "1 lights have no range, and end where they give 0.01 W/m^2");
}

// Exporters write the largest float for "infinite".
TEST(GltfLight, ARangeBeyondAnyLevelIsNone) {
  for (double range : {3.4028234663852886e38, 1e300, 2e9}) {
    Scene scene = lit_file({{"type", "point"}, {"intensity", 4}, {"range", range}}, Json::object()).load();
    EXPECT_FLOAT_EQ(scene.lights[0].radius, 20.0f) << range;
    EXPECT_EQ(rejection_reason(scene.lights[0]), nullptr);
  }
  EXPECT_EQ(lit_file({{"type", "point"}, {"range", 1e6}}, Json::object()).load().lights[0].radius, 1e6f);
}

TEST(GltfLight, WithoutIntensityItIsDark) {
  for (const Json& light : {Json{{"type", "point"}, {"intensity", 0}},
                            Json{{"type", "point"}, {"intensity", 5}, {"color", {0, 0, 0}}, {"range", 3}}}) {
    const Scene scene = lit_file(light, Json::object()).load();
    LightSpec spec;
    spec.placement = Placement::gltf;
    const LightSet set(spec, scene);
    EXPECT_EQ(set.account().dark, 1u);
    EXPECT_EQ(set.account().rejected(), 0u);
    EXPECT_TRUE(set.base().empty());
  }
}

TEST(GltfLight, UnusableOnesAreLeftToTheLightSet) {
  Scene scene = lit_file({{"type", "point"}, {"intensity", -1}, {"range", 0}}, Json::object()).load();
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].radius, 0.0f);
}

TEST(GltfLight, DirectionalIsNoted) {
  Scene scene = lit_file({{"type", "directional"}}, Json::object()).load();
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.rejected_lights.at("directional (a sun)"), 1u);
  EXPECT_EQ(scene.notes.back(),
            "1 directional light (a sun) is not used: the bench's lights have a place and a radius");
}

}  // namespace
}  // namespace ml
