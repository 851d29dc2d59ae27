// Accessors, buffer views and buffers that lie about their bytes: each is refused with one line that names
// file and place.
#include <gtest/gtest.h>

#include <cmath>

#include "bad_file.h"

namespace ml {
namespace {

class GltfBadBytes : public testing::TestWithParam<BadFile> {};

TEST_P(GltfBadBytes, IsRefusedWithItsPlace) {
  GltfTestFile file = triangle_file();
  GetParam().spoil(file);
  EXPECT_EQ(message_of(file.glb()), "test.glb: " + GetParam().message);
}

// The accessors of triangle_file() are 0 (positions) and 1 (indices), on the buffer views 0 and 1.
const BadFile bad_accessors[] = {
    {"PastItsView", [](auto& f) { f.json["accessors"][0]["count"] = 4; },
     "accessors[0]: reaches 12 bytes past bufferViews[0]"},
    {"HugeCount", [](auto& f) { f.json["accessors"][1]["count"] = 2147483647; },
     "accessors[1]: has 2147483647 indices, more than the limit of 50331648"},
    {"HugeVertexCount", [](auto& f) { f.json["accessors"][0]["count"] = 2000000000; },
     "accessors[0]: has 2000000000 elements, more than the limit of 16777216"},
    {"HugeOffset", [](auto& f) { f.json["accessors"][0]["byteOffset"] = 2147483647; },
     "accessors[0]: reaches 2147483647 bytes past bufferViews[0]"},
    {"OffsetPast64Bits", [](auto& f) { f.json["accessors"][0]["byteOffset"] = 1e19; },
     "accessors[0].byteOffset: is 1e+19, expected an integer from 0 to 2147483647"},
    {"NegativeOffset", [](auto& f) { f.json["accessors"][0]["byteOffset"] = -4; },
     "accessors[0].byteOffset: is -4, expected an integer from 0 to 2147483647"},
    {"CountOfZero", [](auto& f) { f.json["accessors"][0]["count"] = 0; },
     "accessors[0].count: is 0, expected an integer from 1 to 2147483647"},
    {"CountWithFraction", [](auto& f) { f.json["accessors"][0]["count"] = 2.5; },
     "accessors[0].count: expected an integer"},
    {"CountAsText", [](auto& f) { f.json["accessors"][0]["count"] = "3"; },
     "accessors[0].count: expected an integer"},
    {"IndicesWithoutView", [](auto& f) { f.json["accessors"][1].erase("bufferView"); },
     "meshes[0].primitives[0].indices: accessors[1] has no buffer view, which is supported for vertices "
     "alone"},
    {"NoCount", [](auto& f) { f.json["accessors"][0].erase("count"); }, "accessors[0]: 'count' is missing"},
    {"UnknownComponentType", [](auto& f) { f.json["accessors"][0]["componentType"] = 5130; },
     "accessors[0].componentType: is 5130, which is none of the values that glTF allows"},
    {"UnknownType", [](auto& f) { f.json["accessors"][0]["type"] = "VEC5"; },
     "accessors[0].type: unknown value 'VEC5', did you mean 'VEC2'?"},
    {"WrongType", [](auto& f) { f.json["accessors"][0]["type"] = "VEC2"; },
     "meshes[0].primitives[0].attributes.POSITION: expected VEC3 elements in accessors[0]"},
    {"PositionsOf32BitIntegers", [](auto& f) { f.json["accessors"][0]["componentType"] = 5125; },
     "meshes[0].primitives[0].attributes.POSITION: expected floats or 8- or 16-bit integers in accessors[0]"},
    {"IndicesAsFloats", [](auto& f) { f.json["accessors"][1]["componentType"] = 5126; },
     "meshes[0].primitives[0].indices: expected unsigned 8-, 16- or 32-bit integers in accessors[1]"},
    {"ViewOutOfRange", [](auto& f) { f.json["accessors"][0]["bufferView"] = 2; },
     "accessors[0].bufferView: is 2, but the file has 2 bufferViews"},
    {"NegativeView", [](auto& f) { f.json["accessors"][0]["bufferView"] = -1; },
     "accessors[0].bufferView: is -1, but the file has 2 bufferViews"},
    {"ManyElementsOutOfNothing",
     [](auto& f) {
       f.json["accessors"][0].erase("bufferView");
       f.json["accessors"][0]["count"] = 10000000;
     },
     "accessors[0]: has 10000000 elements without a buffer view"},
    {"NormalsOfAnotherCount",
     [](auto& f) {
       f.primitive()["attributes"]["NORMAL"] = f.floats({0, 1, 0}, "VEC3");
     },
     "meshes[0].primitives[0].attributes.NORMAL: accessors[2] has 1 elements, but there are 3 positions"},
    {"NotANumber",
     [](auto& f) {
       f.primitive()["attributes"]["POSITION"] = f.floats({0, 0, 0, 0, NAN, 4, 4, 0, 0}, "VEC3");
     },
     "accessors[2]: element 1 is not finite"},
    {"Infinite",
     [](auto& f) {
       f.primitive()["attributes"]["POSITION"] = f.floats({0, 0, 0, 0, 0, 4, INFINITY, 0, 0}, "VEC3");
     },
     "accessors[2]: element 2 is not finite"},
    {"TooFar",
     [](auto& f) {
       f.primitive()["attributes"]["POSITION"] = f.floats({0, 0, 0, 0, 0, 4, 3e38f, 0, 0}, "VEC3");
     },
     "meshes[0].primitives[0]: on nodes[0] its vertex 2 lies more than 1e9 m from the origin"},
    {"IndexOutOfRange",
     [](auto& f) {
       f.primitive()["indices"] = f.accessor(std::vector<uint16_t>{0, 1, 3}, 5123, "SCALAR");
     },
     "meshes[0].primitives[0].indices: accessors[2] element 2 is 3, but there are 3 vertices"},
    {"PrimitiveRestart",
     [](auto& f) {
       f.primitive()["indices"] = f.accessor(std::vector<uint32_t>{0, 0xffffffff, 1}, 5125, "SCALAR");
     },
     "meshes[0].primitives[0].indices: accessors[2] element 1 is 4294967295, but there are 3 vertices"},
};
INSTANTIATE_TEST_SUITE_P(Accessor, GltfBadBytes, testing::ValuesIn(bad_accessors),
                         [](const auto& i) { return i.param.name; });

void sparse(GltfTestFile& f, int count, const std::vector<uint16_t>& indices,
            const std::vector<float>& values) {
  int index_view = f.view(indices), value_view = f.view(values);
  f.json["accessors"][0]["sparse"] = {{"count", count},
                                      {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", value_view}}}};
}

const BadFile bad_sparse[] = {
    {"IndexOutOfRange",
     [](auto& f) {
       sparse(f, 1, {3}, {1, 2, 3});
     },
     "accessors[0].sparse.indices: element 0 is 3, but the accessor has 3 elements"},
    {"TooManyElements",
     [](auto& f) {
       sparse(f, 4, {0, 1, 2, 2}, std::vector<float>(12));
     },
     "accessors[0].sparse.count: is more than the accessor's count"},
    {"IndicesPastTheirView", [](auto& f) { sparse(f, 3, {0}, std::vector<float>(9)); },
     "accessors[0].sparse.indices: reaches 4 bytes past bufferViews[2]"},
    {"ValuesPastTheirView",
     [](auto& f) {
       sparse(f, 3, {0, 1, 2}, {1, 2, 3});
     },
     "accessors[0].sparse.values: reaches 24 bytes past bufferViews[3]"},
    {"NoValues",
     [](auto& f) {
       sparse(f, 1, {0}, {1, 2, 3});
       f.json["accessors"][0]["sparse"].erase("values");
     },
     "accessors[0].sparse: 'values' is missing"},
};
INSTANTIATE_TEST_SUITE_P(Sparse, GltfBadBytes, testing::ValuesIn(bad_sparse),
                         [](const auto& i) { return i.param.name; });

const BadFile bad_buffers[] = {
    {"ViewPastTheBuffer", [](auto& f) { f.json["bufferViews"][1]["byteLength"] = 24; },
     "bufferViews[1]: reaches 12 bytes past buffers[0]"},
    {"ViewOffsetPastTheBuffer", [](auto& f) { f.json["bufferViews"][1]["byteOffset"] = 2147483647; },
     "bufferViews[1]: reaches 2147483611 bytes past buffers[0]"},
    {"StrideTooSmall", [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 8; },
     "accessors[0]: its elements have 12 bytes, but the stride of bufferViews[0] is 8"},
    {"StrideTooLarge", [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 256; },
     "bufferViews[0].byteStride: is 256, expected an integer from 4 to 252"},
    {"StrideOddlySized", [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 14; },
     "bufferViews[0].byteStride: is 14, expected a multiple of 4"},
    {"BufferLongerThanItsBytes",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 4000}}});
     },
     "buffers[0]: byteLength is 4000, but there are 48 bytes"},
    {"BufferWithoutBytes",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 48}}, {{"byteLength", 4}}});
     },
     "buffers[1]: has neither a URI nor the binary chunk of a GLB"},
    {"NoBuffers", [](auto& f) { f.json["buffers"] = Json::array(); },
     "bufferViews[0].buffer: is 0, but the file has 0 buffers"},
    {"ExternalBuffer",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 48}, {"uri", "level.bin"}}});
     },
     "buffers[0].uri: external files are refused here: 'level.bin'"},
    {"DataUriWithoutBase64",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 48}, {"uri", "data:,abc"}}});
     },
     "buffers[0].uri: expected a data URI with ';base64,'"},
    {"DataUriOfOtherLetters",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 48}, {"uri", "data:;base64,AA*A"}}});
     },
     "buffers[0].uri: the data URI is not base64"},
    {"DataUriTooShort",
     [](auto& f) {
       f.json["buffers"] = Json::array({{{"byteLength", 48}, {"uri", "data:;base64,AAAA"}}});
     },
     "buffers[0]: byteLength is 48, but there are 3 bytes"},
};
INSTANTIATE_TEST_SUITE_P(Buffer, GltfBadBytes, testing::ValuesIn(bad_buffers),
                         [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace ml
