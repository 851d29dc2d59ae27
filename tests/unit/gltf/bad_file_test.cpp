// Files that lie, end early, or ask for too much: each is refused with one line that names the file and the
// place.
#include "bad_file.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "harness/gltf/gltf.h"

namespace ml {
namespace {

class GltfBadFile : public testing::TestWithParam<BadFile> {};

TEST_P(GltfBadFile, IsRefusedWithItsPlace) {
  GltfTestFile file = triangle_file();
  GetParam().spoil(file);
  EXPECT_EQ(message_of(file.glb()), "test.glb: " + GetParam().message);
}

const BadFile bad_nodes[] = {
    {"OwnChild",
     [](auto& f) {
       f.json["nodes"].push_back({{"children", {2}}});
     },
     "nodes[2]: is its own ancestor"},
    {"Cycle",
     [](auto& f) {
       f.json["nodes"].push_back({{"children", {3}}});
       f.json["nodes"].push_back({{"children", {4}}});
       f.json["nodes"].push_back({{"children", {2}}});
     },
     "nodes[3]: is its own ancestor"},
    {"TwoParents",
     [](auto& f) {
       f.json["nodes"].push_back({{"children", {0}}});
       f.json["nodes"].push_back({{"children", {0}}});
     },
     "nodes[0]: has two parents, nodes[2] and nodes[3]"},
    {"ChildListedTwice",
     [](auto& f) {
       f.json["nodes"].push_back({{"children", {0, 0}}});
     },
     "nodes[0]: has two parents, nodes[2] and nodes[2]"},
    {"ChildOutOfRange", [](auto& f) { f.json["nodes"][0]["children"] = {9}; },
     "nodes[0].children[0]: is 9, but the file has 2 nodes"},
    {"TooDeep",
     [](auto& f) {
       for (int i = 0; i < 1024; ++i) f.json["nodes"].push_back({{"children", {i ? i + 1 : 0}}});
     },
     "nodes[0]: lies more than 1024 levels deep"},
    {"MatrixOf15", [](auto& f) { f.json["nodes"][0]["matrix"] = std::vector<double>(15, 1.0); },
     "nodes[0].matrix: expected 16 numbers"},
    {"ProjectiveMatrix", [](auto& f) { f.json["nodes"][0]["matrix"] = std::vector<double>(16, 1.0); },
     "nodes[0].matrix: expected 0 0 0 1 as its last row"},
    {"MatrixThatOverflows",
     [](auto& f) {
       f.json["nodes"][0]["scale"] = {1e300, 1, 1};
       f.json["nodes"].push_back({{"scale", {1e300, 1, 1}}, {"children", {0}}});
       f.json["scenes"][0]["nodes"] = {2, 1};
     },
     "nodes[0]: its world transform is not finite"},
    {"NoRotation",
     [](auto& f) {
       f.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "nodes[0].rotation: expected a unit quaternion"},
    {"MeshOutOfRange", [](auto& f) { f.json["nodes"][0]["mesh"] = 1; },
     "nodes[0].mesh: is 1, but the file has 1 meshes"},
    {"NoTriangles", [](auto& f) { f.json["nodes"][0].erase("mesh"); }, "scene: has no triangles"},
    {"OnlyPoints", [](auto& f) { f.primitive()["mode"] = 0; }, "scene: has no triangles"},
    {"UnknownMode", [](auto& f) { f.primitive()["mode"] = 7; },
     "meshes[0].primitives[0].mode: is 7, expected an integer from 0 to 6"},
    {"MaterialOutOfRange", [](auto& f) { f.primitive()["material"] = 0; },
     "meshes[0].primitives[0].material: is 0, but the file has 0 materials"},
    {"TooManyInstances",
     [](auto& f) {
       f.mesh(std::vector<float>(3 * 30000, 1.0f));
       for (int i = 0; i < 600; ++i) {
         f.json["scenes"][0]["nodes"].push_back(f.json["nodes"].size());
         f.json["nodes"].push_back({{"mesh", 1}});
       }
     },
     "meshes[1].primitives[0]: the scene has more than 16777216 vertices or triangles"},
    {"SceneOutOfRange", [](auto& f) { f.json["scene"] = 1; }, "scene: is 1, but the file has 1 scenes"},
};
INSTANTIATE_TEST_SUITE_P(Node, GltfBadFile, testing::ValuesIn(bad_nodes),
                         [](const auto& i) { return i.param.name; });

void animate(GltfTestFile& f, const std::vector<float>& times, const std::vector<float>& values,
             int sampler = 0) {
  int input = f.floats(times, "SCALAR"), output = f.floats(values, "VEC3");
  f.json["animations"] = Json::array(
      {{{"channels",
         Json::array({{{"sampler", sampler}, {"target", {{"node", 1}, {"path", "translation"}}}}})},
        {"samplers", Json::array({{{"input", input}, {"output", output}}})}}});
}

void light_up(GltfTestFile& f, const Json& light, int index = 0) {
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  f.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = index;
}
const BadFile bad_content[] = {
    {"NoAsset", [](auto& f) { f.json.erase("asset"); }, "top level: 'asset' is missing"},
    {"OldVersion", [](auto& f) { f.json["asset"]["version"] = "1.0"; },
     "asset.version: the file is glTF 1.0, but 2.0 is needed"},
    {"LaterVersion", [](auto& f) { f.json["asset"]["version"] = "3.0"; },
     "asset.version: expected glTF 2.x, found '3.0'"},
    {"NewMinimum", [](auto& f) { f.json["asset"]["minVersion"] = "2.1"; },
     "asset.minVersion: expected 2.0, found '2.1'"},
    {"UnknownExtension", [](auto& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "extensionsRequired[0]: the file needs KHR_draco_mesh_compression, which is not supported"},
    {"DracoThatIsNotRequired",
     [](auto& f) {
       f.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
       f.json["accessors"][1].erase("bufferView");
     },
     "meshes[0].primitives[0]: the file needs KHR_draco_mesh_compression, which is not supported"},
    {"MeshoptThatIsNotRequired",
     [](auto& f) {
       f.json["buffers"] = Json::array(
           {{{"byteLength", f.binary.size()}},
            {{"byteLength", 4}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
     },
     "buffers[1]: the file needs EXT_meshopt_compression, which is not supported"},
    {"MisspeltExtension", [](auto& f) { f.json["extensionsRequired"] = {"KHR_mesh_quantisation"}; },
     "extensionsRequired[0]: the file needs KHR_mesh_quantisation, which is not supported, did you mean "
     "'KHR_mesh_quantization'?"},
    {"MeshesAsObject", [](auto& f) { f.json["meshes"] = Json::object(); },
     "nodes[0].mesh: is 0, but the file has 0 meshes"},
    {"NodesAsNumber", [](auto& f) { f.json["nodes"] = 5; },
     "scenes[0].nodes[0]: is 0, but the file has 0 nodes"},
    {"NodeAsNumber", [](auto& f) { f.json["nodes"][0] = 5; }, "nodes[0]: expected an object"},
    {"NameAsNumber", [](auto& f) { f.json["nodes"][0]["name"] = 5; }, "nodes[0].name: expected a string"},
    {"CameraWithoutLens", [](auto& f) { f.json["cameras"][0].erase("perspective"); },
     "cameras[0]: 'perspective' is missing"},
    {"CameraWithoutOpening", [](auto& f) { f.json["cameras"][0]["perspective"]["yfov"] = 0; },
     "cameras[0].perspective.yfov: is 0, expected a number above 0 and at most 3.1415926"},
    {"FlatOrthographic",
     [](auto& f) {
       f.json["cameras"][0] = {{"type", "orthographic"},
                               {"orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}};
     },
     "cameras[0].orthographic: expected an xmag and ymag that are not 0"},
    {"OrthographicBackwards",
     [](auto& f) {
       f.json["cameras"][0] = {{"type", "orthographic"},
                               {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 2}, {"zfar", 1}}}};
     },
     "cameras[0].orthographic.zfar: expected more than znear"},
    {"CameraOfNoSize",
     [](auto& f) {
       f.json["nodes"][1]["scale"] = {0, 0, 0};
     },
     "nodes[1]: its camera has no finite position and direction"},
    {"TimesStandStill",
     [](auto& f) {
       animate(f, {0, 1, 1}, std::vector<float>(9));
     },
     "animations[0].samplers[0].input: its times do not increase at key 2"},
    {"TooFewAnimatedValues",
     [](auto& f) {
       animate(f, {0, 1, 2}, std::vector<float>(6));
     },
     "animations[0].samplers[0].output: has 2 elements, expected 3"},
    {"SamplerOutOfRange",
     [](auto& f) {
       animate(f, {0, 1}, std::vector<float>(6), 3);
     },
     "animations[0].channels[0].sampler: is 3, but the animation has 1 samplers"},
    {"LightOutOfRange",
     [](auto& f) {
       light_up(f, {{"type", "point"}}, 1);
     },
     "nodes[1].extensions.KHR_lights_punctual.light: is 1, but the file has 1 "
     "extensions.KHR_lights_punctual.lights"},
    {"UnknownLight",
     [](auto& f) {
       light_up(f, {{"type", "spotty"}});
     },
     "extensions.KHR_lights_punctual.lights[0].type: unknown value 'spotty', did you mean 'spot'?"},
    {"SpotWithoutCone",
     [](auto& f) {
       light_up(f, {{"type", "spot"}});
     },
     "extensions.KHR_lights_punctual.lights[0]: 'spot' is missing"},
    {"TextureOutOfRange",
     [](auto& f) {
       f.json["materials"] =
           Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
     },
     "materials[0].pbrMetallicRoughness.baseColorTexture.index: is 0, but the file has 0 textures"},
    {"JointOutOfRange",
     [](auto& f) {
       f.json["skins"] = Json::array({{{"joints", {0, 7}}}});
     },
     "skins[0].joints[1]: is 7, but the file has 2 nodes"},
    {"SkinWithoutJoints", [](auto& f) { f.json["skins"] = Json::array({Json::object()}); },
     "skins[0]: 'joints' is missing"},
    {"VisibleAsNumber",
     [](auto& f) { f.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = 1; },
     "nodes[0].extensions.KHR_node_visibility.visible: expected true or false"},
    {"InstancesOfOtherCounts",
     [](auto& f) {
       f.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
           {"TRANSLATION", f.floats({0, 0, 0, 1, 0, 0}, "VEC3")}, {"SCALE", f.floats({1, 1, 1}, "VEC3")}};
     },
     "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: has 1 elements, but others have 2"},
    {"InstancesWithoutRotation",
     [](auto& f) {
       f.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
           f.floats({0, 0, 0, 0}, "VEC4");
     },
     "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.ROTATION: element 0 is no unit quaternion"},
    {"JointThatTheSkinDoesNotHave",
     [](auto& f) {
       f.json["skins"] = Json::array({{{"joints", {0}}}});
       f.json["nodes"][0]["skin"] = 0;
       f.primitive()["attributes"]["JOINTS_0"] =
           f.accessor(std::vector<uint8_t>{0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0}, 5121, "VEC4");
       f.primitive()["attributes"]["WEIGHTS_0"] = f.floats({1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
     },
     "meshes[0].primitives[0].attributes.JOINTS_0: vertex 1 hangs on a joint that its skin does not have; it "
     "has 1"},
    {"ColorsOfOtherCount",
     [](auto& f) {
       f.primitive()["attributes"]["COLOR_0"] = f.floats({1, 1, 1}, "VEC3");
     },
     "meshes[0].primitives[0].attributes.COLOR_0: accessors[2] has 1 elements, but there are 3 positions"},
    {"NegativeStrength",
     [](auto& f) {
       f.json["materials"] =
           Json::array({{{"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", -1}}}}}}});
     },
     "materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: is -1, expected a number of "
     "at "
     "least 0.0"},
    {"OwnPlanesTurnedAround",
     [](auto& f) {
       f.json["asset"]["extras"]["manylights"] = {{"near", 10}, {"far", 1}};
     },
     "asset.extras.manylights: expected 0 < near < far"},
};
INSTANTIATE_TEST_SUITE_P(Content, GltfBadFile, testing::ValuesIn(bad_content),
                         [](const auto& i) { return i.param.name; });

void set_word(std::string& bytes, size_t offset, uint32_t value) {
  std::memcpy(bytes.data() + offset, &value, 4);
}

TEST(GltfBadContainer, HeadersAndChunks) {
  const std::string good = triangle_file().glb();
  EXPECT_EQ(message_of(good), "accepted");
  EXPECT_EQ(message_of(""), "test.glb: the file is empty");
  EXPECT_EQ(message_of("glTF"), "test.glb: header: a GLB starts with 12 bytes, but the file has 4");
  EXPECT_EQ(message_of(good.substr(0, good.size() - 1)),
            "test.glb: header: the length is " + std::to_string(good.size()) + " bytes, but the file has " +
                std::to_string(good.size() - 1));
  std::string bad = good;
  set_word(bad, 4, 1);
  EXPECT_EQ(message_of(bad), "test.glb: header: expected GLB version 2, found 1");
  bad = good;
  set_word(bad, 8, 12);
  EXPECT_EQ(message_of(bad), "test.glb: header: the file has no JSON chunk");
  bad = good;
  set_word(bad, 8, 16);
  EXPECT_EQ(message_of(bad), "test.glb: chunk[0]: its header is cut off");
  bad = good;
  set_word(bad, 12, 0xffffffff);
  EXPECT_EQ(message_of(bad), "test.glb: chunk[0]: reaches " +
                                 std::to_string(0xffffffff - (good.size() - 20)) +
                                 " bytes past the end of the file");
  bad = good;
  bad[16] = 'X';
  EXPECT_EQ(message_of(bad), "test.glb: chunk[0]: expected the JSON chunk first");
}

TEST(GltfBadContainer, EveryTruncationIsRefused) {
  const std::string good = triangle_file().glb();
  for (size_t size = 0; size < good.size(); ++size) {
    std::string message = message_of(good.substr(0, size));
    EXPECT_NE(message, "accepted") << size;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(GltfBadContainer, BrokenJson) {
  EXPECT_EQ(message_of("[]"), "test.glb: JSON: expected an object at the top");
  EXPECT_TRUE(message_of("{\"asset\":").starts_with("test.glb: JSON: parse error at line 1, column 10"));
  EXPECT_TRUE(message_of("{\"asset\": 1e999}").starts_with("test.glb: JSON: number overflow"));
  EXPECT_TRUE(message_of("\xff\xfe").starts_with("test.glb: JSON: parse error"));
  // Nested far deeper than any stack is deep: both where the importer looks, and where it does not.
  std::string nested = std::string(1000000, '[') + std::string(1000000, ']');
  EXPECT_EQ(message_of("{\"asset\": " + nested + "}"), "test.glb: asset: expected an object");
  std::string aside = triangle_file().json.dump();
  aside.insert(1, "\"extras\": " + nested + ",");
  EXPECT_EQ(message_of(GltfTestFile::glb_of(aside, triangle_file().binary)),
            "test.glb: bufferViews[0].buffer: is 0, but the file has 0 buffers");
}

TEST(GltfBadContainer, MissingScene) {
  EXPECT_EQ(message_of(triangle_file().glb(), 4), "test.glb: scenes: scene 4 is wanted, but the file has 1");
}

TEST(GltfBadContainer, MissingFileAndFilesElsewhere) {
  EXPECT_THROW(import_gltf("/nowhere/level.glb", -1, 1, glm::dvec3(0)), UsageError);
  std::string folder = testing::TempDir();
  for (const char* uri : {"/etc/passwd", "../secret.bin", "a/../../secret.bin", "%2e%2e/secret.bin",
                          "http://host/a.bin", "file:///etc/passwd", "a\\b.bin", ""}) {
    GltfTestFile file = triangle_file();
    file.json["buffers"] = Json::array({{{"byteLength", file.binary.size()}, {"uri", uri}}});
    std::string path = folder + "/manylights-elsewhere.gltf";
    FILE* out = std::fopen(path.c_str(), "wb");
    ASSERT_NE(out, nullptr);
    std::fputs(file.json.dump().c_str(), out);
    std::fclose(out);
    try {
      import_gltf(path, -1, 1, glm::dvec3(0));
      ADD_FAILURE() << uri;
    } catch (const UsageError& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with(path + ": buffers[0].uri: expected a file in or below ")) << text;
      EXPECT_NE(text.find("found '" + std::string(uri) + "'"), text.npos) << text;
    }
    std::remove(path.c_str());
  }
}

}  // namespace
}  // namespace ml
