// Materials, textures and external files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/gltf/gltf.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;
namespace fs = std::filesystem;

// A 2 x 1 PNG: red, and green with alpha 128.
const std::vector<uint8_t> tiny_png = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
    0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0xf4,
    0x22, 0x7f, 0x8a, 0x00, 0x00, 0x00, 0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8,
    0xcf, 0xc0, 0xf0, 0x1f, 0x08, 0x1b, 0x00, 0x10, 0x79, 0x03, 0x7e, 0x7d, 0x63, 0xce, 0xd7,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

// A 2 x 1 JPEG of one grey, 200.
const std::vector<uint8_t> tiny_jpeg = {
    0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10, 0x4a, 0x46, 0x49, 0x46, 0x00, 0x01, 0x01, 0x00, 0x00, 0x01,
    0x00, 0x01, 0x00, 0x00, 0xff, 0xdb, 0x00, 0x43, 0x00, 0x10, 0x0b, 0x0c, 0x0e, 0x0c, 0x0a, 0x10,
    0x0e, 0x0d, 0x0e, 0x12, 0x11, 0x10, 0x13, 0x18, 0x28, 0x1a, 0x18, 0x16, 0x16, 0x18, 0x31, 0x23,
    0x25, 0x1d, 0x28, 0x3a, 0x33, 0x3d, 0x3c, 0x39, 0x33, 0x38, 0x37, 0x40, 0x48, 0x5c, 0x4e, 0x40,
    0x44, 0x57, 0x45, 0x37, 0x38, 0x50, 0x6d, 0x51, 0x57, 0x5f, 0x62, 0x67, 0x68, 0x67, 0x3e, 0x4d,
    0x71, 0x79, 0x70, 0x64, 0x78, 0x5c, 0x65, 0x67, 0x63, 0xff, 0xc0, 0x00, 0x0b, 0x08, 0x00, 0x01,
    0x00, 0x02, 0x01, 0x01, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x14, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06, 0xff, 0xc4, 0x00, 0x14,
    0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01, 0x00, 0x00, 0x3f, 0x00, 0x48, 0xff, 0xd9};

std::string base64(const void* data, size_t size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const uint8_t*>(data);
  std::string text;
  for (size_t i = 0; i < size; i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = (bits << 8) | (i + k < size ? bytes[i + k] : 0);
    for (size_t k = 0; k < 4; ++k) text += i + k <= size ? digits[(bits >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

GltfTestFile textured_file() {
  GltfTestFile file = triangle_file();
  file.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  file.json["textures"] = Json::array({{{"source", 0}}});
  file.json["images"] =
      Json::array({{{"bufferView", file.view(tiny_png)}, {"mimeType", "image/png"}, {"name", "flag"}}});
  file.primitive()["material"] = 0;
  file.primitive()["attributes"]["TEXCOORD_0"] = file.floats({0, 0, 0, 1, 1, 0}, "VEC2");
  return file;
}

TEST(GltfMaterial, FactorsAndModes) {
  GltfTestFile file = triangle_file();
  file.json["materials"] = Json::array(
      {{{"name", "a"},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.75},
        {"doubleSided", true}},
       {{"name", "b"}},
       {{"name", "c"}, {"alphaMode", "BLEND"}, {"alphaCutoff", 0.1}}});
  file.primitive()["material"] = 0;
  Scene scene = file.load();
  ASSERT_EQ(scene.materials.size(), 3u);
  const Material &a = scene.materials[0], &b = scene.materials[1], &c = scene.materials[2];
  EXPECT_EQ(a.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 0.75f));
  EXPECT_EQ(a.metallic, 0.5f);
  EXPECT_EQ(a.roughness, 0.25f);
  EXPECT_EQ(a.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(a.alpha_cutoff, 0.75f);
  EXPECT_TRUE(a.double_sided);
  // glTF's defaults, which are not those of Material.
  EXPECT_EQ(b.base_color, glm::vec4(1));
  EXPECT_EQ(b.metallic, 1.0f);
  EXPECT_EQ(b.roughness, 1.0f);
  EXPECT_EQ(b.alpha_mode, AlphaMode::opaque);
  EXPECT_FALSE(b.double_sided);
  EXPECT_EQ(c.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(c.alpha_cutoff, 0.5f);
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"1 materials blend, and are drawn as masks with cutoff 0.5"});
}

TEST(GltfMaterial, ForwardStandsInTheExtras) {
  GltfTestFile file = triangle_file();
  file.json["materials"] = Json::array({{{"extras", {{"manylights", {{"forward", true}}}}}},
                                        {{"extras", {{"manylights", {{"forward", false}}}}}},
                                        {{"extras", {{"manylights", 7}}}},
                                        {{"extras", "somebody else's"}},
                                        {{"name", "plain"}}});
  file.primitive()["material"] = 0;
  Scene scene = file.load();
  for (size_t i = 0; i < scene.materials.size(); ++i) EXPECT_EQ(scene.materials[i].forward, i == 0) << i;
  file.json["materials"][0]["extras"]["manylights"]["forward"] = "yes";
  EXPECT_THROW(file.load(), UsageError);
}

TEST(GltfMaterial, PrimitivesWithoutMaterialGetThePlainOne) {
  Scene scene = triangle_file().load();
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].metallic, 0.0f);
  EXPECT_EQ(scene.draws[0].material, 0u);
  EXPECT_EQ(scene.notes.size(), 1u);
}

TEST(GltfMaterial, TexturesAreDecodedToSrgbBytes) {
  GltfTestFile inside = textured_file(), data_uri = textured_file();
  data_uri.json["images"][0] = {{"uri", "data:image/png;base64," + base64(tiny_png.data(), tiny_png.size())}};
  for (const Scene& scene : {inside.load(), data_uri.load()}) {
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].width, 2u);
    EXPECT_EQ(scene.textures[0].height, 1u);
    EXPECT_EQ(scene.textures[0].rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    EXPECT_EQ(scene.materials[0].base_color_texture, 0);
  }
}

Scene with_image(const std::vector<uint8_t>& image) {
  GltfTestFile file = textured_file();
  file.json["images"][0] = {{"bufferView", file.view(image)}};
  return file.load();
}

TEST(GltfMaterial, JpegIsDecoded) {
  Scene scene = with_image(tiny_jpeg);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width, 2u);
  EXPECT_EQ(scene.textures[0].rgba, (std::vector<uint8_t>{200, 200, 200, 255, 200, 200, 200, 255}));
}

// What the level says of a picture that it draws white instead; empty where it read the picture.
std::string trouble_with(const std::vector<uint8_t>& image) {
  Scene scene = with_image(image);
  EXPECT_EQ(scene.textures.empty(), scene.materials[0].base_color_texture == -1);
  if (!scene.textures.empty()) return "";
  EXPECT_EQ(scene.notes.size(), 1u);
  const std::string start = "1 images cannot be read, and are drawn white (normal maps flat): images[0]: ";
  EXPECT_TRUE(scene.notes[0].starts_with(start)) << scene.notes[0];
  return scene.notes[0].substr(start.size());
}

TEST(GltfMaterial, BrokenJpegsAreWhite) {
  // No prefix may crash; one without a whole scan may not pass for the picture either.
  for (size_t size = 0; size + 4 < tiny_jpeg.size(); ++size)
    EXPECT_NE(trouble_with(
                  {tiny_jpeg.begin(), tiny_jpeg.begin() + static_cast<ptrdiff_t>(std::max<size_t>(size, 1))}),
              "")
        << size;
  // Huffman sizes that add up to more than the 256 codes a table has space for.
  std::vector<uint8_t> bad = tiny_jpeg;
  for (size_t i = 0; i + 21 < bad.size(); ++i)
    if (bad[i] == 0xff && bad[i + 1] == 0xc4)
      std::fill_n(bad.begin() + static_cast<ptrdiff_t>(i + 5), 16, uint8_t{255});
  EXPECT_NE(trouble_with(bad), "");
}

// The header of a PNG of that size, and nothing after it.
std::vector<uint8_t> png_header(uint32_t width, uint32_t height) {
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  for (uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) png.push_back(static_cast<uint8_t>(side >> shift));
  png.insert(png.end(), {8, 6, 0, 0, 0, 0, 0, 0, 0});
  return png;
}

TEST(GltfMaterial, PicturesThatAreNoneAreWhiteAndNamed) {
  EXPECT_EQ(trouble_with({1, 2, 3, 4}), "not a PNG or JPEG that can be decoded: unknown image type");
  EXPECT_EQ(trouble_with({'R', 'I', 'F', 'F', 9, 9, 9, 9, 'W', 'E', 'B', 'P'}),
            "expected a PNG or a JPEG, found WebP");
  EXPECT_EQ(trouble_with(png_header(16000, 8000)), "16000 x 8000 pixels cannot come out of 33 bytes");
  EXPECT_EQ(trouble_with(png_header(70000, 8)),
            "the image is too large: 70000 x 8 pixels, more than 16384 on a side");
  EXPECT_EQ(trouble_with(png_header(0, 8)), "the image has no pixels");
}

TEST(GltfMaterial, OneImageIsDecodedOnce) {
  GltfTestFile file = textured_file();
  file.json["textures"].push_back({{"source", 0}});
  file.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  Scene scene = file.load();
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials[1].base_color_texture, 0);
}

TEST(GltfMaterial, TextureTransformMovesCoordinates) {
  GltfTestFile file = textured_file();
  file.primitive()["attributes"]["TEXCOORD_1"] = file.floats({1, 0, 0, 1, 0.5f, 0.5f}, "VEC2");
  file.json["extensionsRequired"] = {"KHR_texture_transform"};
  // Of a quarter turn and a stretch by (2, 1): (u, v) becomes (v + 10, 20 - 2 u).
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
           ["KHR_texture_transform"] = {
      {"offset", {10, 20}}, {"rotation", 1.5707963267948966}, {"scale", {2, 1}}, {"texCoord", 1}};
  Scene scene = file.load();
  const glm::vec2 expected[] = {{10, 18}, {11, 20}, {10.5f, 19}};
  for (size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(scene.vertices[i].uv - expected[i]), 1e-5f) << i;
}

TEST(GltfExternal, BuffersAndImagesBelowTheFolder) {
  fs::path folder = fs::temp_directory_path() / ("manylights-external-" + std::to_string(getpid()));
  fs::create_directories(folder / "data");
  GltfTestFile file = textured_file();
  file.json["buffers"] = Json::array({{{"byteLength", file.binary.size()}, {"uri", "data/my%20bytes.bin"}}});
  file.json["images"][0] = {{"uri", "data/flag.png"}};
  write_file(folder / "data" / "my bytes.bin", file.binary);
  write_file(folder / "data" / "flag.png", std::as_bytes(std::span(tiny_png)));
  write_file(folder / "level.gltf", file.json.dump());
  Scene scene = import_gltf(folder / "level.gltf", -1, 1, dvec3(0));
  EXPECT_EQ(scene.name, "level");
  EXPECT_EQ(scene.triangle_count(), 1u);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].name, "data/flag.png");
  fs::remove_all(folder);
}

TEST(GltfExternal, AboveTheFolderWhereTheRootAllowsIt) {
  fs::path folder = fs::temp_directory_path() / ("manylights-root-" + std::to_string(getpid()));
  fs::create_directories(folder / "levels");
  fs::create_directories(folder / "textures");
  GltfTestFile file = textured_file();
  file.json["images"][0] = {{"uri", "../textures/flag.png"}};
  write_file(folder / "textures" / "flag.png", std::as_bytes(std::span(tiny_png)));
  write_file(folder / "levels" / "level.glb", file.glb());
  const fs::path level = folder / "levels" / "level.glb";
  // By itself a level reads nothing outside its folder: the texture is white, and the note says how to have
  // it.
  Scene alone = import_gltf(level, -1, 1, dvec3(0));
  EXPECT_TRUE(alone.textures.empty());
  ASSERT_EQ(alone.notes.size(), 1u);
  EXPECT_NE(alone.notes[0].find("scene.root"), std::string::npos) << alone.notes[0];
  EXPECT_EQ(import_gltf(level, -1, 1, dvec3(0), folder).textures.size(), 1u);
  // A root elsewhere is no root of the level's.
  EXPECT_TRUE(import_gltf(level, -1, 1, dvec3(0), folder / "textures" / "deeper").textures.empty());
  // One that is missing is white too.
  fs::remove(folder / "textures" / "flag.png");
  EXPECT_TRUE(import_gltf(level, -1, 1, dvec3(0), folder).textures.empty());
  fs::remove_all(folder);
}

TEST(GltfExternal, DataUris) {
  GltfTestFile file = triangle_file();
  file.json["buffers"] = Json::array(
      {{{"byteLength", file.binary.size()},
        {"uri", "data:application/octet-stream;base64," + base64(file.binary.data(), file.binary.size())}}});
  EXPECT_EQ(GltfTestFile::load_bytes(file.json.dump()).triangle_count(), 1u);
}

TEST(GltfNotes, WhatIsNotDrawnIsSaid) {
  GltfTestFile file = triangle_file();
  file.json["materials"] = Json::array(
      {{{"occlusionTexture", {{"index", 0}}}, {"extensions", {{"KHR_materials_clearcoat", Json::object()}}}},
       {{"extensions", {{"KHR_materials_clearcoat", Json::object()}}}}});
  file.json["extensionsRequired"] = {"KHR_materials_clearcoat"};
  file.primitive()["material"] = 0;
  file.primitive()["targets"] = Json::array();
  file.primitive()["attributes"]["COLOR_1"] = 0;
  file.primitive()["attributes"]["_WIND"] = 0;
  Scene scene = file.load();
  EXPECT_EQ(
      scene.notes,
      (std::vector<std::string>{
          "the file needs KHR_materials_clearcoat, which is not supported: materials are drawn without it",
          "1 primitives have morph targets, which are ignored",
          "1 sets of vertex colours behind the first are ignored",
          "1 vertex attributes of the file's own (_NAME) are ignored",
          "1 materials have occlusion textures, which are ignored",
          "2 uses of KHR_materials_clearcoat, which is ignored"}));
}

}  // namespace
}  // namespace ml
