// glTF files as a user brings them: broken ones are refused in one line, whole ones are measured.
#include <cstring>

#include "harness/gltf/gltf.h"
#include "harness/lights/set.h"
#include "harness/scene/scene.h"
#include "scenes/load_scene.h"
#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

// A triangle as glTF with its bytes in a data URI (0,0,0, 1,0,0, 0,1,0 as floats).
json triangle() {
  return json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 36,
      "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]})");
}

SceneSpec procedural(const std::string& name) {
  SceneSpec spec;
  spec.procedural = name;
  return spec;
}

void expect_refused(const Folder& folder, const std::string& file, const std::vector<std::string>& parts) {
  SCOPED_TRACE(file);
  json config = small_config({{"scene", {{"gltf", (folder / file).string()}}}, {"lights", {{"count", 4}}}});
  std::vector<std::string> all = parts;
  all.push_back(file);
  expect_error(manylights({"run", write_config(folder, config), "--out", (folder / "out").string()}), 2, all);
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "result.json"));
}

TEST(LevelFiles, DamagedFilesAreRefused) {
  Folder folder;
  expect_refused(folder, "missing.glb", {"no such file"});
  Outcome made =
      manylights({"scene", "plane", "--out", (folder / "plane.glb").string(), "--set", "lights.count=3"});
  ASSERT_EQ(made.code, 0) << made.error;
  const std::string whole = text_of(folder / "plane.glb");
  for (size_t bytes : {size_t{0}, size_t{3}, size_t{12}, size_t{19}, whole.size() / 2, whole.size() - 1}) {
    write_text(folder / "cut.glb", whole.substr(0, bytes));
    expect_refused(folder, "cut.glb", {});
  }
  std::string bad = whole;
  bad[4] = 1;  // glTF 1.0
  write_text(folder / "version.glb", bad);
  expect_refused(folder, "version.glb", {});
  bad = whole;
  bad[22] = '!';
  write_text(folder / "text.glb", bad);
  expect_refused(folder, "text.glb", {});
}

TEST(LevelFiles, LyingFilesAreRefused) {
  Folder folder;
  auto refuse = [&](const std::string& name, const std::function<void(json&)>& lie,
                    const std::vector<std::string>& parts) {
    json document = triangle();
    lie(document);
    write_text(folder / name, document.dump());
    expect_refused(folder, name, parts);
  };
  refuse("view.gltf", [](json& d) { d["bufferViews"][0]["byteLength"] = 360; }, {"bufferViews[0]"});
  refuse("offset.gltf", [](json& d) { d["bufferViews"][0]["byteOffset"] = 4294967290u; }, {"bufferViews[0]"});
  refuse("count.gltf", [](json& d) { d["accessors"][0]["count"] = 4; }, {"accessors[0]"});
  refuse("length.gltf", [](json& d) { d["buffers"][0]["byteLength"] = 37; }, {"buffers[0]"});
  refuse("mesh.gltf", [](json& d) { d["nodes"][0]["mesh"] = 7; }, {"nodes[0]"});
  refuse("cycle.gltf",
         [](json& d) {
           d["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}};
         },
         {"nodes["});
  refuse("self.gltf", [](json& d) { d["nodes"][0]["children"] = {0}; }, {"nodes[0]"});
  // The first coordinate is a NaN.
  refuse("nan.gltf",
         [](json& d) {
           std::string uri = d["buffers"][0]["uri"];
           uri.replace(uri.find(',') + 1, 8, "AADAfwAA");
           d["buffers"][0]["uri"] = uri;
         },
         {"accessors[0]"});
  refuse("points.gltf", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 0; }, {"triangle"});
  refuse("empty.gltf", [](json& d) { d["nodes"] = {{{"name", "nothing"}}}; }, {"triangle"});
}

TEST(LevelFiles, ExportedScenesAreWholeAndTheSameAgain) {
  Folder folder;
  for (const char* name : {"plane", "canyon", "citadel", "grove"}) {
    const std::string first = (folder / (std::string(name) + ".glb")).string(),
                      second = (folder / (std::string(name) + "2.glb")).string();
    for (const std::string& file : {first, second}) {
      Outcome made = manylights({"scene", name, "--out", file, "--set", "lights.count=300"});
      ASSERT_EQ(made.code, 0) << made.error;
    }
    EXPECT_EQ(text_of(first), text_of(second));
    Scene direct = load_scene(procedural(name)), back = import_gltf(first, -1, 1, glm::dvec3(0));
    EXPECT_EQ(back.triangle_count(), direct.triangle_count());
    EXPECT_EQ(back.lights.size(), 300u);
    EXPECT_LT(glm::length(back.bounds.size() - direct.bounds.size()), 1e-3f);
    EXPECT_FALSE(back.path("default").keys.empty());
  }
}

TEST(LevelFiles, ExportedScenesPassTheKhronosValidator) {
  Folder folder;
  for (const char* name : {"canyon", "citadel", "grove"}) {
    const std::string file = (folder / (std::string(name) + ".glb")).string();
    ASSERT_EQ(manylights({"scene", name, "--out", file, "--set", "lights=" + all_shapes(100).dump()}).code,
              0);
    Outcome checked = run_process({"node", ML_SOURCE_DIR "/tests/end_to_end/validate_gltf.mjs", file});
    if (checked.code == 77 || checked.code == 127)
      GTEST_SKIP() << "node or its package gltf-validator is not installed";
    EXPECT_EQ(checked.code, 0) << name << ": " << checked.out << checked.error;
  }
}

class RealLevel : public testing::TestWithParam<const char*> {};

TEST_P(RealLevel, IsProven) {
  const char* shared = std::getenv("MANYLIGHTS_SHARED");
  const std::filesystem::path file = std::filesystem::path(shared ? shared : ML_SOURCE_DIR "/../shared") /
                                     "scenes" / (std::string(GetParam()) + ".glb");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  Folder folder;
  json config =
      small_config({{"scene", {{"gltf", file.string()}}},
                    {"lights", all_shapes(2048)},
                    {"resolution", {160, 90}},
                    {"algorithms", {"ideal", "clustered", {{"name", "clustered"}, {"refinement", true}}}}});
  Outcome outcome = manylights({"verify", write_config(folder, config), "--frames", "2", "--brute-force",
                                "4000000", "--validation", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.error;
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" 0 failed"), std::string::npos) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Levels, RealLevel, testing::Values("zdm2", "pandora", "oasago2", "islandctf"),
                         [](const auto& level) { return std::string(level.param); });

}  // namespace
}  // namespace ml::test
