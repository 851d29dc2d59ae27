#include <gtest/gtest.h>

#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

TEST(GltfNode, TranslationRotationAndScaleAreOneMatrix) {
  // A quarter turn about z, then a stretch along the node's x, moved.
  double h = std::sqrt(0.5);
  GltfTestFile parts = triangle_file(), matrix = triangle_file();
  parts.json["nodes"][0]["translation"] = {1, 2, 3};
  parts.json["nodes"][0]["rotation"] = {0, 0, h, h};
  parts.json["nodes"][0]["scale"] = {2, 1, 1};
  matrix.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
  for (const Scene& scene : {parts.load(), matrix.load()}) {
    EXPECT_LT(glm::length(corner_of(scene, 0, 0) - dvec3(1, 2, 3)), 1e-6);
    EXPECT_LT(glm::length(corner_of(scene, 0, 1) - dvec3(1, 2, 7)), 1e-6);
    EXPECT_LT(glm::length(corner_of(scene, 0, 2) - dvec3(1, 10, 3)), 1e-6);
  }
}

TEST(GltfNode, ParentsMoveTheirChildren) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][0]["translation"] = {1, 0, 0};
  file.json["nodes"].push_back({{"scale", {3, 3, 3}}, {"children", {0}}});
  file.json["nodes"].push_back({{"translation", {0, 10, 0}}, {"children", {2}}});
  file.json["scenes"][0]["nodes"] = {3, 1};
  EXPECT_EQ(corner_of(file.load(), 0, 0), dvec3(3, 10, 0));
}

TEST(GltfNode, OneMeshOnManyNodes) {
  GltfTestFile file = triangle_file();
  for (int i = 1; i < 5; ++i) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {10 * i, 0, 0}}});
  }
  Scene scene = file.load();
  ASSERT_EQ(scene.triangle_count(), 5u);
  for (size_t t = 0; t < 5; ++t) EXPECT_EQ(corner_of(scene, t, 0), dvec3(10.0 * double(t), 0, 0));
}

TEST(GltfNode, RotationsNeedNotBeExactlyUnit) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][0]["rotation"] = {0, 0, 3, 3};
  EXPECT_LT(glm::length(corner_of(file.load(), 0, 2) - dvec3(0, 4, 0)), 1e-6);
}

TEST(GltfNode, TheWantedSceneIsLoaded) {
  GltfTestFile file = triangle_file();
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {50, 0, 0}}});
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {60, 0, 0}}});
  file.json["scenes"].push_back({{"nodes", {2, 3}}});
  EXPECT_EQ(file.load().triangle_count(), 1u);  // without "scene": the first
  EXPECT_EQ(file.load(0).triangle_count(), 1u);
  EXPECT_EQ(file.load(1).triangle_count(), 2u);
  file.json["scene"] = 1;
  EXPECT_EQ(file.load().triangle_count(), 2u);
  EXPECT_EQ(file.load(0).triangle_count(), 1u);
}

TEST(GltfNode, AFileWithoutScenesIsAllItsNodes) {
  GltfTestFile file = triangle_file();
  file.json.erase("scenes");
  file.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(file.load().triangle_count(), 2u);
}

TEST(GltfNode, DeepButNotTooDeep) {
  GltfTestFile file = triangle_file();
  for (int depth = 0; depth < 1023; ++depth)
    file.json["nodes"].push_back({{"translation", {1, 0, 0}}, {"children", {depth ? depth + 1 : 0}}});
  file.json["scenes"][0]["nodes"] = {1, 1024};
  EXPECT_EQ(corner_of(file.load(), 0, 0), dvec3(1023, 0, 0));
}

}  // namespace
}  // namespace ml
