// Instances, skins, hidden nodes, and nodes that a scene lists below others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/base/error.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

bool has_corner(const Scene& scene, const dvec3& corner) {
  for (size_t i = 0; i < scene.indices.size(); ++i)
    if (glm::length(corner_of(scene, i / 3, i % 3) - corner) < 1e-5) return true;
  return false;
}

dvec3 face_normal(const Scene& scene, size_t triangle) {
  const dvec3 a = corner_of(scene, triangle, 0);
  return glm::normalize(glm::cross(corner_of(scene, triangle, 1) - a, corner_of(scene, triangle, 2) - a));
}

TEST(GltfInstances, EachIsPlacedLikeANode) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][0]["translation"] = {100, 0, 0};
  Json& attributes = file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = file.floats({0, 0, 0, 10, 0, 0, 0, 5, 0}, "VEC3");
  // A quarter turn about y as normalized 16-bit integers; lengths that are not quite 1 are brought to it.
  const auto h = static_cast<int16_t>(23170);
  attributes["ROTATION"] =
      file.accessor(std::vector<int16_t>{0, 0, 0, 32767, 0, h, 0, h, 0, 0, 0, 32767}, 5122, "VEC4", true);
  attributes["SCALE"] = file.floats({1, 1, 1, 1, 1, 1, -2, 2, 2}, "VEC3");
  Scene scene = file.load();
  ASSERT_EQ(scene.triangle_count(), 3u);
  for (const dvec3& corner :
       {dvec3(100, 0, 0), dvec3(100, 0, 4), dvec3(104, 0, 0),   // as it is
        dvec3(110, 0, 0), dvec3(114, 0, 0), dvec3(110, 0, -4),  // turned
        dvec3(100, 5, 0), dvec3(100, 5, 8), dvec3(92, 5, 0)})   // mirrored, twice as large
    EXPECT_TRUE(has_corner(scene, corner)) << corner.x << ", " << corner.y << ", " << corner.z;
  // A mirrored triangle still faces up, front and normals.
  for (size_t triangle = 0; triangle < 3; ++triangle) {
    EXPECT_GT(face_normal(scene, triangle).y, 0.99) << triangle;
    EXPECT_GT(scene.vertices[scene.indices[3 * triangle]].normal.y, 0.99f) << triangle;
  }
}

TEST(GltfInstances, TooManyAreRefusedBeforeMemoryIsAskedFor) {
  GltfTestFile file = triangle_file();
  // A hundred thousand instances of a mesh of 300 vertices; accessors without bytes are all 0.
  file.mesh(std::vector<float>(3 * 300, 1.0f));
  file.json["nodes"][0]["mesh"] = 1;
  file.json["accessors"].push_back({{"componentType", 5126}, {"count", 100000}, {"type", "VEC3"}});
  file.binary.resize(100000);
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      file.json["accessors"].size() - 1;
  try {
    file.load();
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()),
              "test.glb: nodes[0]: with its 100000 instances the scene has more than 16777216 vertices");
  }
}

TEST(GltfVisibility, HidesANodeAndAllBelowIt) {
  GltfTestFile file = triangle_file();
  // 2 is hidden and holds 3 (a mesh), 4 (a light) and 5 (a camera).
  for (Json node :
       {Json{{"children", {3, 4, 5}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
        Json{{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}},
        Json{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        Json{{"camera", 0}, {"name", "hidden eye"}}})
    file.json["nodes"].push_back(node);
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}, {"range", 3}}});
  file.json["extensionsRequired"] = {"KHR_node_visibility"};
  Scene scene = file.load();
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.rejected_lights.at("hidden (KHR_node_visibility)"), 1u);
  EXPECT_EQ(scene.path("hidden eye").name, "hidden eye") << "what is looked through need not be seen";
  EXPECT_NE(std::find(scene.notes.begin(), scene.notes.end(),
                      "1 meshes are hidden (KHR_node_visibility), and are not drawn"),
            scene.notes.end());
}

// A square of 1 x 1 m whose upper corners hang on the second joint; the joints are nodes 2 and 3.
GltfTestFile skinned_file() {
  GltfTestFile file = triangle_file();
  file.mesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3});
  Json& attributes = file.json["meshes"][1]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] =
      file.accessor(std::vector<uint16_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5123, "VEC4");
  attributes["WEIGHTS_0"] = file.accessor(
      std::vector<uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, 5121, "VEC4", true);
  file.json["nodes"][0] = {{"mesh", 1}, {"skin", 0}, {"translation", {1000, 0, 0}}};
  file.json["nodes"].push_back({{"children", {3}}, {"translation", {0, 2, 0}}});
  file.json["nodes"].push_back({{"translation", {0, 3, 0}}});
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["skins"] = Json::array({{{"joints", {2, 3}}}});
  return file;
}

TEST(GltfSkin, VerticesStandByTheirJoints) {
  // Not where their own node is: joint 0 is at 2 m, joint 1 at 5 m.
  Scene scene = skinned_file().load();
  for (const dvec3& corner : {dvec3(0, 2, 0), dvec3(1, 2, 0), dvec3(1, 6, 0), dvec3(0, 6, 0)})
    EXPECT_TRUE(has_corner(scene, corner)) << corner.y;
}

TEST(GltfSkin, InverseBindMatricesAndScale) {
  GltfTestFile file = skinned_file();
  // The skeleton is in centimetres; both joints were bound at the origin.
  file.json["nodes"][2]["scale"] = {0.01, 0.01, 0.01};
  std::vector<float> inverses(32, 0.0f);
  for (size_t joint = 0; joint < 2; ++joint)
    for (size_t i = 0; i < 4; ++i) inverses[16 * joint + 5 * i] = i < 3 ? 100.0f : 1.0f;
  inverses[16 + 13] = -300;  // undoes joint 1's own translation of 3 cm
  file.json["skins"][0]["inverseBindMatrices"] = file.floats(inverses, "MAT4");
  Scene scene = file.load();
  for (const dvec3& corner : {dvec3(0, 2, 0), dvec3(1, 2, 0), dvec3(1, 0.03, 0), dvec3(0, 0.03, 0)})
    EXPECT_TRUE(has_corner(scene, corner)) << corner.y;
}

TEST(GltfSkin, WeightsOfSeveralSetsAreMixed) {
  GltfTestFile file = skinned_file();
  Json& attributes = file.json["meshes"][1]["primitives"][0]["attributes"];
  // Half and half, in two sets; together they weigh 0.5, which is brought to 1.
  attributes["WEIGHTS_0"] = file.floats({.25f, 0, 0, 0, .25f, 0, 0, 0, .25f, 0, 0, 0, .25f, 0, 0, 0}, "VEC4");
  attributes["JOINTS_1"] =
      file.accessor(std::vector<uint8_t>{1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4");
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  Scene scene = file.load();
  for (const dvec3& corner : {dvec3(0, 3.5, 0), dvec3(1, 4.5, 0)}) EXPECT_TRUE(has_corner(scene, corner));
}

TEST(GltfSkin, AMirroredJointTurnsNoTriangleInsideOut) {
  GltfTestFile file = skinned_file();
  file.json["nodes"][2]["scale"] = {-1, 1, 1};
  Scene scene = file.load();
  for (size_t triangle = 0; triangle < 2; ++triangle) EXPECT_GT(face_normal(scene, triangle).z, 0.99);
}

TEST(GltfScene, ANodeBelowAnotherIsDrawnOnceWhereItsParentPutsIt) {
  GltfTestFile file = triangle_file();
  file.json["nodes"].push_back({{"children", {0}}, {"translation", {0, 7, 0}}});
  for (const Json& listed : {Json{0, 1}, Json{0, 1, 2}, Json{2, 0, 1}, Json{0, 0, 1}}) {
    file.json["scenes"][0]["nodes"] = listed;
    Scene scene = file.load();
    ASSERT_EQ(scene.triangle_count(), 1u) << listed;
    EXPECT_EQ(corner_of(scene, 0, 0), dvec3(0, 7, 0)) << listed;
    EXPECT_EQ(std::count(scene.notes.begin(), scene.notes.end(),
                         (listed == Json{0, 0, 1} ? "2" : "1") +
                             std::string(" nodes that the scene lists lie below others or are listed twice; "
                                         "each is drawn once, where its parents put it")),
              1)
        << listed;
  }
}

}  // namespace
}  // namespace ml
