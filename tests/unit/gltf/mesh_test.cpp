#include <gtest/gtest.h>

#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

dvec3 face_normal(const Scene& scene, size_t triangle) {
  dvec3 a = corner_of(scene, triangle, 0), b = corner_of(scene, triangle, 1),
        c = corner_of(scene, triangle, 2);
  return glm::normalize(glm::cross(b - a, c - a));
}

// Positions of a 2 x 1 m quad in the plane y = 0 as a strip; as indices, `order` says which corner comes
// when.
const std::vector<float> quad = {0, 0, 0, 0, 0, 1, 2, 0, 0, 2, 0, 1};

Scene with_mode(int mode, const std::vector<uint32_t>& order) {
  GltfTestFile file = triangle_file();
  file.mesh(quad, order);
  file.json["meshes"][1]["primitives"][0]["mode"] = mode;
  file.json["nodes"][0]["mesh"] = 1;
  return file.load();
}

TEST(GltfMesh, ListStripAndFanMeanTheSameSurface) {
  for (const Scene& scene :
       {with_mode(4, {0, 1, 2, 2, 1, 3}), with_mode(5, {0, 1, 2, 3}), with_mode(6, {0, 1, 3, 2})}) {
    ASSERT_EQ(scene.triangle_count(), 2u);
    for (size_t t = 0; t < 2; ++t) EXPECT_EQ(face_normal(scene, t), dvec3(0, 1, 0));
    double area = 0;
    for (size_t t = 0; t < 2; ++t)
      area += 0.5 * glm::length(glm::cross(corner_of(scene, t, 1) - corner_of(scene, t, 0),
                                           corner_of(scene, t, 2) - corner_of(scene, t, 0)));
    EXPECT_DOUBLE_EQ(area, 2);
  }
}

TEST(GltfMesh, LongStripKeepsItsWinding) {
  std::vector<float> positions;
  for (int i = 0; i < 9; ++i)
    positions.insert(positions.end(), {static_cast<float>(i / 2), 0, static_cast<float>(i % 2)});
  GltfTestFile file = triangle_file();
  file.mesh(positions);
  file.json["meshes"][1]["primitives"][0]["mode"] = 5;
  file.json["nodes"][0]["mesh"] = 1;
  Scene scene = file.load();
  ASSERT_EQ(scene.triangle_count(), 7u);
  for (size_t t = 0; t < 7; ++t) EXPECT_EQ(face_normal(scene, t), dvec3(0, 1, 0)) << t;
}

TEST(GltfMesh, IncompleteTrianglesAreDropped) {
  EXPECT_EQ(with_mode(4, {0, 1, 2, 2, 1}).triangle_count(), 1u);
}

TEST(GltfMesh, PointsAndLinesAreNotedAndNotDrawn) {
  GltfTestFile file = triangle_file();
  file.json["meshes"][0]["primitives"].push_back(file.primitive());
  file.json["meshes"][0]["primitives"][1]["mode"] = 1;
  Scene scene = file.load();
  EXPECT_EQ(scene.triangle_count(), 1u);
  ASSERT_FALSE(scene.notes.empty());
  EXPECT_EQ(scene.notes[0], "1 primitives are points or lines, which are not drawn");
}

TEST(GltfMesh, UnindexedIsTheSameAsIndexed) {
  GltfTestFile indexed = triangle_file(), unindexed = triangle_file();
  unindexed.primitive().erase("indices");
  Scene a = indexed.load(), b = unindexed.load();
  ASSERT_EQ(b.triangle_count(), 1u);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(corner_of(a, 0, k), corner_of(b, 0, k));
}

TEST(GltfMesh, MissingNormalsAreFlat) {
  // Two triangles at a right angle that share an edge.
  GltfTestFile file = triangle_file();
  file.mesh({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 3, 1});
  file.json["nodes"][0]["mesh"] = 1;
  Scene scene = file.load();
  for (size_t t = 0; t < 2; ++t)
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(dvec3(scene.vertices[scene.indices[3 * t + k]].normal), face_normal(scene, t));
}

TEST(GltfMesh, UnusableNormalsComeFromTheTriangles) {
  GltfTestFile file = triangle_file();
  file.primitive()["attributes"]["NORMAL"] = file.floats({0, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3");
  Scene scene = file.load();
  for (const Vertex& vertex : scene.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
}

TEST(GltfMesh, DegenerateTrianglesStayAndHaveUnitNormals) {
  GltfTestFile file = triangle_file();
  file.mesh({1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 1, 1});
  file.json["meshes"][1]["primitives"][0]["indices"] =
      file.accessor(std::vector<uint8_t>{0, 1, 2, 0, 1, 3}, 5121, "SCALAR");
  file.json["nodes"][0]["mesh"] = 1;
  Scene scene = file.load();
  EXPECT_EQ(scene.triangle_count(), 2u);
  for (const Vertex& vertex : scene.vertices) EXPECT_EQ(glm::length(vertex.normal), 1.0f);
}

TEST(GltfMesh, NegativeScaleKeepsTheOutsideOutside) {
  // Outside is where the normals point: the winding must agree with them, mirrored or not.
  for (dvec3 scale : {dvec3(1), dvec3(-1, 1, 1), dvec3(-1, -2, 3), dvec3(-1, -1, -1), dvec3(2, 1, -0.5)}) {
    for (bool with_normals : {false, true}) {
      GltfTestFile file = triangle_file();
      if (with_normals)
        file.primitive()["attributes"]["NORMAL"] = file.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
      file.json["nodes"][0]["scale"] = {scale.x, scale.y, scale.z};
      Scene scene = file.load();
      dvec3 outside(0, scale.y > 0 ? 1 : -1, 0);
      EXPECT_LT(glm::length(face_normal(scene, 0) - outside), 1e-6)
          << scale.x << " " << scale.y << " " << scale.z;
      for (const Vertex& vertex : scene.vertices)
        EXPECT_LT(glm::length(dvec3(vertex.normal) - outside), 1e-6);
    }
  }
}

TEST(GltfMesh, NormalsStaySquareToStretchedSurfaces) {
  GltfTestFile file = triangle_file();
  float h = std::sqrt(0.5f);
  file.mesh({0, 0, 0, 0, 0, 1, 1, -1, 0});  // a slope of 45 degrees
  file.json["meshes"][1]["primitives"][0]["attributes"]["NORMAL"] =
      file.floats({h, h, 0, h, h, 0, h, h, 0}, "VEC3");
  file.json["nodes"][0] = {{"mesh", 1}, {"scale", {3, 1, 0.2}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}};
  Scene scene = file.load();
  for (const Vertex& vertex : scene.vertices)
    EXPECT_LT(glm::length(dvec3(vertex.normal) - face_normal(scene, 0)), 1e-6);
}

TEST(GltfMesh, PrimitivesOfOneMeshShareTheirVertices) {
  GltfTestFile file = triangle_file();
  file.primitive()["attributes"]["NORMAL"] = file.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  file.json["meshes"][0]["primitives"].push_back(file.primitive());
  Scene scene = file.load();
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.vertices.size(), 3u);
}

TEST(GltfMesh, DrawsCoverAllIndicesOncePerMaterial) {
  GltfTestFile file = triangle_file();
  file.json["materials"] = Json::array({{{"name", "a"}}, {{"name", "b"}}});
  Json first = file.primitive(), second = file.primitive();
  first["material"] = 1, second["material"] = 0;
  file.json["meshes"][0]["primitives"] = Json::array({first, second, first});
  Scene scene = file.load();
  ASSERT_EQ(scene.draws.size(), 2u);
  EXPECT_EQ(scene.draws[0].material, 0u);
  EXPECT_EQ(scene.draws[0].index_count, 3u);
  EXPECT_EQ(scene.draws[1].first_index, 3u);
  EXPECT_EQ(scene.draws[1].index_count, 6u);
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST(GltfMesh, OriginIsOffsetPlusWholeMetresNearTheMiddle) {
  GltfTestFile file = triangle_file();
  file.json["nodes"][0]["translation"] = {100.25, -7, 3};
  Scene near = file.load(), far = file.load(-1, dvec3(1e7, 0, -3));
  EXPECT_EQ(near.origin, glm::floor(near.origin));
  EXPECT_EQ(far.origin, near.origin + dvec3(1e7, 0, -3));
  EXPECT_LE(glm::length(glm::dvec3(near.bounds.center())), std::sqrt(3.0) / 2);
  EXPECT_EQ(corner_of(near, 0, 0), dvec3(100.25, -7, 3));
  for (size_t i = 0; i < near.vertices.size(); ++i)
    EXPECT_EQ(near.vertices[i].position, far.vertices[i].position);
}

TEST(GltfMesh, FarNodesKeepTheirPrecision) {
  // Two nodes far from zero that nearly cancel out: 1e8 + 0.125 is not a float.
  GltfTestFile file = triangle_file();
  file.json["nodes"][0]["translation"] = {0.125, 0, 0};
  file.json["nodes"].push_back({{"translation", {1e8, 0, 1e8}}, {"children", {0}}});
  file.json["scenes"][0]["nodes"] = {2, 1};
  Scene scene = file.load();
  EXPECT_EQ(corner_of(scene, 0, 0), dvec3(1e8 + 0.125, 0, 1e8));
}

TEST(GltfMesh, BoundsAndFarFollowTheVertices) {
  Scene scene = triangle_file().load();
  EXPECT_EQ(scene.bounds.size(), glm::vec3(4, 0, 4));
  EXPECT_FLOAT_EQ(scene.far, std::sqrt(32.0f));
  EXPECT_EQ(scene.near, 0.1f);
}

}  // namespace
}  // namespace ml
