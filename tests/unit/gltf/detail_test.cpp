// Vertex colours, tangents, texture coordinates of several sets, samplers, emission.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

// The triangle with normals, and a material with the four textures; none of them has a picture.
GltfTestFile detailed_file() {
  GltfTestFile file = triangle_file();
  file.json["textures"] = Json::array({Json::object()});
  file.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  file.primitive()["material"] = 0;
  file.primitive()["attributes"]["NORMAL"] = file.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  file.primitive()["attributes"]["TEXCOORD_0"] = file.floats({0, 0, 0, 1, 1, 0}, "VEC2");
  file.primitive()["attributes"]["TEXCOORD_3"] = file.floats({5, 5, 5, 6, 6, 5}, "VEC2");
  return file;
}

TEST(GltfDetails, AFileWithoutAnyHasNone) {
  EXPECT_TRUE(triangle_file().load().details.empty());
  GltfTestFile file = detailed_file();
  file.json["materials"][0]["normalTexture"] = {{"index", 0}};
  // The same coordinates as the base colour's.
  EXPECT_TRUE(file.load().details.empty());
}

TEST(GltfDetails, ColorsOfEveryType) {
  const std::vector<float> rgb = {1, 0, 0, 0, 1, 0, 0, 0, 0.2f};
  for (int kind = 0; kind < 5; ++kind) {
    GltfTestFile file = triangle_file();
    Json& color = file.primitive()["attributes"]["COLOR_0"];
    if (kind == 0) color = file.floats(rgb, "VEC3");
    if (kind == 1) color = file.floats({1, 0, 0, 0.5f, 0, 1, 0, 0.5f, 0, 0, 0.2f, 0.5f}, "VEC4");
    if (kind == 2)
      color = file.accessor(std::vector<uint16_t>{65535, 0, 0, 0, 65535, 0, 0, 0, 13107}, 5123, "VEC3", true);
    if (kind == 3)
      color = file.accessor(std::vector<uint8_t>{255, 0, 0, 128, 0, 255, 0, 128, 0, 0, 51, 128}, 5121, "VEC4",
                            true);
    // Files that forget to say `normalized` mean it.
    if (kind == 4)
      color =
          file.accessor(std::vector<uint8_t>{255, 0, 0, 128, 0, 255, 0, 128, 0, 0, 51, 128}, 5121, "VEC4");
    const Scene scene = file.load();
    ASSERT_EQ(scene.details.colors.size(), scene.vertices.size()) << kind;
    for (size_t i = 0; i < 3; ++i) {
      const glm::vec4& found = scene.details.colors[scene.indices[i]];
      for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[static_cast<int>(c)], rgb[3 * i + c], 1e-6f) << kind;
      EXPECT_NEAR(found.a, kind == 0 || kind == 2 ? 1 : 0.5f, 0.01f) << kind;
    }
  }
}

TEST(GltfDetails, MeshesWithoutColorsAreWhiteBesideOthers) {
  GltfTestFile file = triangle_file();
  file.mesh({9, 0, 0, 9, 0, 4, 13, 0, 0}, {0, 1, 2});
  file.mesh({19, 0, 0, 19, 0, 4, 23, 0, 0}, {0, 1, 2});
  file.json["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] =
      file.floats({0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  file.json["nodes"].push_back({{"mesh", 1}});
  file.json["nodes"].push_back({{"mesh", 2}});
  file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Scene scene = file.load();
  ASSERT_EQ(scene.details.colors.size(), scene.vertices.size());
  for (size_t i = 0; i < scene.vertices.size(); ++i) {
    const double x = static_cast<double>(scene.vertices[i].position.x) + scene.origin.x;
    EXPECT_EQ(scene.details.colors[i].r, x > 8 && x < 15 ? 0.0f : 1.0f) << x;
  }
}

TEST(GltfDetails, EveryTextureHasItsOwnCoordinates) {
  GltfTestFile file = detailed_file();
  Json& material = file.json["materials"][0];
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}, {"texCoord", 3}};
  material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  material["emissiveTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {10, 20}}, {"scale", {2, 3}}}}}}};
  material["emissiveFactor"] = {1, 0.5, 0.25};
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 8;
  const Scene scene = file.load();
  EXPECT_EQ(scene.materials[0].normal_scale, 0.5f);
  EXPECT_EQ(scene.materials[0].emission, glm::vec3(8, 4, 2));
  ASSERT_EQ(scene.details.metallic_roughness_uv.size(), scene.vertices.size());
  ASSERT_EQ(scene.details.emission_uv.size(), scene.vertices.size());
  EXPECT_TRUE(scene.details.normal_uv.empty()) << "the base colour's";
  for (size_t i = 0; i < scene.vertices.size(); ++i) {
    const glm::vec2 uv = scene.vertices[i].uv;
    EXPECT_EQ(scene.details.metallic_roughness_uv[i], uv + 5.0f);
    EXPECT_EQ(scene.details.emission_uv[i], uv * glm::vec2(2, 3) + glm::vec2(10, 20));
  }
}

TEST(GltfDetails, TangentsTurnWithTheirNodeAndAreMirroredWithIt) {
  GltfTestFile file = detailed_file();
  file.primitive()["attributes"]["TANGENT"] = file.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4");
  EXPECT_TRUE(file.load().details.tangents.empty()) << "there is no normal map";
  file.json["materials"][0]["normalTexture"] = {{"index", 0}};
  const float h = std::sqrt(0.5f);
  for (const bool mirrored : {false, true}) {
    file.json["nodes"][0]["rotation"] = {0, h, 0, h};  // x becomes -z
    file.json["nodes"][0]["scale"] = {3, 1, mirrored ? -1 : 1};
    const Scene scene = file.load();
    ASSERT_EQ(scene.details.tangents.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
      const glm::vec4& tangent = scene.details.tangents[i];
      EXPECT_LT(glm::length(glm::vec3(tangent) - glm::vec3(0, 0, -1)), 1e-6f);
      EXPECT_EQ(tangent.w, (i == 2 ? -1.0f : 1.0f) * (mirrored ? -1.0f : 1.0f)) << i;
    }
  }
  file.primitive()["attributes"].erase("NORMAL");
  EXPECT_TRUE(file.load().details.tangents.empty()) << "flat normals have no use for them";
}

TEST(GltfDetails, MissingCoordinatesAreSaid) {
  GltfTestFile file = detailed_file();
  file.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 5}};
  const Scene scene = file.load();
  EXPECT_EQ(
      scene.notes.back(),
      "1 primitives lack the texture coordinates that their textures ask for, and show one point of them");
}

}  // namespace
}  // namespace ml
