#include <gtest/gtest.h>

#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

void expect_triangle(const Scene& scene, dvec3 a, dvec3 b, dvec3 c) {
  ASSERT_EQ(scene.triangle_count(), 1u);
  EXPECT_LT(glm::length(corner_of(scene, 0, 0) - a), 1e-6);
  EXPECT_LT(glm::length(corner_of(scene, 0, 1) - b), 1e-6);
  EXPECT_LT(glm::length(corner_of(scene, 0, 2) - c), 1e-6);
}

template <typename T>
void expect_index_type(int component_type) {
  GltfTestFile file = triangle_file();
  file.primitive()["indices"] = file.accessor(std::vector<T>{2, 0, 1}, component_type, "SCALAR");
  expect_triangle(file.load(), {4, 0, 0}, {0, 0, 0}, {0, 0, 4});
}

TEST(GltfAccessor, IndicesOf8And16And32Bits) {
  expect_index_type<uint8_t>(5121);
  expect_index_type<uint16_t>(5123);
  expect_index_type<uint32_t>(5125);
}

TEST(GltfAccessor, IntegerPositionsAsTheyAreAndNormalised) {
  struct Case {
    int type;
    bool normalized;
    double unit;
  };
  auto check = [](auto zero, const Case& c, auto low, auto high) {
    using T = decltype(zero);
    GltfTestFile file = triangle_file();
    std::vector<T> padded = {T(low), 0, 0, 0, 0, 0, T(high), 0, T(high), 0, 0, 0};
    if constexpr (sizeof(T) == 2) padded = {T(low), 0, 0, 0, 0, 0, T(high), 0, T(high)};
    int accessor = file.accessor(padded, c.type, "VEC3", c.normalized);
    file.json["accessors"][static_cast<size_t>(accessor)]["count"] = 3;
    file.primitive()["attributes"]["POSITION"] = accessor;
    expect_triangle(file.load(), {double(low) * c.unit, 0, 0}, {0, 0, 0},
                    {double(high) * c.unit, 0, double(high) * c.unit});
  };
  check(int8_t{}, {5120, false, 1}, -100, 127);
  check(int8_t{}, {5120, true, 1.0 / 127}, -127, 127);
  check(uint8_t{}, {5121, false, 1}, 3, 255);
  check(uint8_t{}, {5121, true, 1.0 / 255}, 51, 255);
  check(int16_t{}, {5122, false, 1}, -32768, 1000);
  check(int16_t{}, {5122, true, 1.0 / 32767}, -32767, 16000);
  check(uint16_t{}, {5123, false, 1}, 0, 65535);
  check(uint16_t{}, {5123, true, 1.0 / 65535}, 13107, 65535);
}

TEST(GltfAccessor, LowestSignedNormalisedIsMinusOne) {
  GltfTestFile file = triangle_file();
  file.primitive()["attributes"]["POSITION"] =
      file.accessor(std::vector<int16_t>{-32768, 0, 0, 0, 0, 0, 32767, 0, 32767}, 5122, "VEC3", true);
  expect_triangle(file.load(), {-1, 0, 0}, {0, 0, 0}, {1, 0, 1});
}

TEST(GltfAccessor, InterleavedWithStrideAndOffsets) {
  GltfTestFile file = triangle_file();
  // Position, normal and texture coordinate of each vertex after 8 bytes that belong to nobody.
  std::vector<float> data = {9, 9};
  std::vector<float> corners = {0, 0, 0, 0, 0, 4, 4, 0, 0};
  for (size_t v = 0; v < 3; ++v) {
    data.insert(data.end(), corners.begin() + static_cast<ptrdiff_t>(3 * v),
                corners.begin() + static_cast<ptrdiff_t>(3 * v + 3));
    data.insert(data.end(), {0, 1, 0, static_cast<float>(v), 0.5f});
  }
  int view = file.view(data);
  file.json["bufferViews"][static_cast<size_t>(view)]["byteStride"] = 32;
  auto add = [&](int offset, const char* type) {
    file.json["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", offset},
                                      {"componentType", 5126},
                                      {"count", 3},
                                      {"type", type}});
    return file.json["accessors"].size() - 1;
  };
  file.primitive()["attributes"] = {
      {"POSITION", add(8, "VEC3")}, {"NORMAL", add(20, "VEC3")}, {"TEXCOORD_0", add(32, "VEC2")}};
  Scene scene = file.load();
  expect_triangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  for (size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(scene.vertices[v].normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.vertices[v].uv, glm::vec2(v, 0.5f));
  }
}

void add_sparse(GltfTestFile& file, Json& accessor, const std::vector<uint16_t>& indices,
                const std::vector<float>& values) {
  int index_view = file.view(indices), value_view = file.view(values);
  accessor["sparse"] = {{"count", indices.size()},
                        {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                        {"values", {{"bufferView", value_view}}}};
}

TEST(GltfAccessor, SparseReplacesElements) {
  GltfTestFile file = triangle_file();
  add_sparse(file, file.json["accessors"][0], {2}, {8, 1, 2});
  expect_triangle(file.load(), {0, 0, 0}, {0, 0, 4}, {8, 1, 2});
}

TEST(GltfAccessor, SparseWithoutBaseStartsFromZero) {
  GltfTestFile file = triangle_file();
  file.json["accessors"][0].erase("bufferView");
  add_sparse(file, file.json["accessors"][0], {0, 2}, {1, 0, 0, 0, 0, 1});
  expect_triangle(file.load(), {1, 0, 0}, {0, 0, 0}, {0, 0, 1});
}

TEST(GltfAccessor, SparseIndices) {
  GltfTestFile file = triangle_file();
  Json& accessor = file.json["accessors"][1];
  int index_view = file.view(std::vector<uint8_t>{0, 2}), value_view = file.view(std::vector<uint32_t>{2, 0});
  accessor["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                        {"values", {{"bufferView", value_view}}}};
  expect_triangle(file.load(), {4, 0, 0}, {0, 0, 4}, {0, 0, 0});
}

TEST(GltfAccessor, TextureCoordinatesOfEveryType) {
  auto check = [](auto one, int type, bool normalized, double unit) {
    using T = decltype(one);
    GltfTestFile file = triangle_file();
    // Rows of 4 bytes at least, as glTF wants them.
    std::vector<T> data;
    constexpr size_t row = sizeof(T) == 1 ? 4 : 2;
    for (size_t v = 0; v < 3; ++v)
      for (size_t c = 0; c < row; ++c) data.push_back(c == 1 ? one : T(0));
    int view = file.view(data);
    file.json["bufferViews"][static_cast<size_t>(view)]["byteStride"] = row * sizeof(T);
    file.json["accessors"].push_back({{"bufferView", view},
                                      {"componentType", type},
                                      {"count", 3},
                                      {"type", "VEC2"},
                                      {"normalized", normalized}});
    file.primitive()["attributes"]["TEXCOORD_0"] = file.json["accessors"].size() - 1;
    for (const Vertex& vertex : file.load().vertices) {
      EXPECT_EQ(vertex.uv.x, 0.0f);
      EXPECT_FLOAT_EQ(vertex.uv.y, static_cast<float>(double(one) * unit));
    }
  };
  check(0.75f, 5126, false, 1);
  check(uint8_t{51}, 5121, true, 1.0 / 255);
  check(uint16_t{13107}, 5123, true, 1.0 / 65535);
  check(int8_t{-127}, 5120, true, 1.0 / 127);
  check(int16_t{77}, 5122, false, 1);
}

}  // namespace
}  // namespace ml
