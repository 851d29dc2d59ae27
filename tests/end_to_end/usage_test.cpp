// What a user can get wrong: the exit code says whose fault it is, and one line says what was expected where.
#include "tests/end_to_end/program.h"
#include "tests/support/drivers.h"

namespace ml::test {
namespace {

using nlohmann::json;

// Runs `run` on the configuration and expects exit code 2, one line with all parts, and no result.
void expect_refused(const json& config, const std::vector<std::string>& parts,
                    std::vector<std::string> more = {}) {
  SCOPED_TRACE(config.dump());
  Folder folder;
  std::vector<std::string> arguments{"run", write_config(folder, config), "--out", (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  expect_error(manylights(arguments), 2, parts);
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "result.json"));
}

TEST(Usage, CommandsAndOptions) {
  expect_error(manylights({}), 2, {"--help"});
  expect_error(manylights({"rnu", "quick"}), 2, {"unknown command 'rnu'", "did you mean 'run'?"});
  expect_error(manylights({"run"}), 2, {"CONFIG", "required"});
  expect_error(manylights({"run", "quick", "--no-such-option"}), 2, {"--no-such-option"});
  expect_error(manylights({"run", "qiuck", "--dry-run"}), 2, {"qiuck"});
  expect_error(manylights({"run", "quick", "--dry-run", "--shard", "3/2"}), 2, {"--shard '3/2'", "I/N"});
  expect_error(manylights({"run", "quick", "--dry-run", "--shard", "2"}), 2, {"--shard '2'"});
  expect_error(manylights({"run", "quick", "--dry-run", "--filter", "["}), 2,
               {"--filter '['", "regular expression"});
  expect_error(manylights({"run", "quick", "--dry-run", "--filter", "no-such-case"}), 2, {"no case is left"});
  expect_error(manylights({"run", "quick", "--dry-run", "--set", "lights"}), 2, {"--set"});
  expect_error(manylights({"list", "algorihtms"}), 2, {"did you mean 'algorithms'?"});
  expect_error(manylights({"render", "quick", "--frame", "16", "--out", "/tmp/never.exr"}), 2,
               {"--frame 16", "0 to 15"});
  expect_error(manylights({"render", "quick", "--frame", "0", "--out", "/tmp/never.jpg"}), 2,
               {".exr or .png"});
  expect_error(manylights({"render", "quick", "--frame", "0", "--out", "/tmp/never.exr", "--aov", "nromal"}),
               2, {"did you mean 'normal'?"});
  expect_error(manylights({"scene", "canyno", "--out", "/tmp/never.glb"}), 2, {"canyon"});
  for (const char* name : {"run", "verify", "render", "list", "scene", "doctor"}) {
    Outcome help = manylights({name, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_FALSE(help.out.empty());
    EXPECT_TRUE(help.error.empty());
  }
}

TEST(Usage, KeysAndTypes) {
  expect_refused(small_config({{"ligths", json::object()}}),
                 {"config.json", "$.ligths", "did you mean 'lights'?"});
  expect_refused(small_config({{"lights", {{"cuont", 3}}}}), {"$.lights.cuont", "did you mean 'count'?"});
  expect_refused(small_config({{"algorithms", {{{"name", "clustered"}, {"tlie", 3}}}}}),
                 {"$.algorithms[0].tlie", "'tile'"});
  expect_refused(small_config({{"algorithms", {"clustred"}}}), {"$.algorithms[0]", "'clustered'"});
  expect_refused(small_config({{"scene", "canyno"}}), {"$.scene", "'canyon'"});
  expect_refused(small_config({{"lights", {{"count", "many"}}}}), {"$.lights.count"});
  expect_refused(small_config({{"resolution", 7}}), {"$.resolution"});
  expect_refused(small_config({{"resolution", {48, 27, 1}}}), {"$.resolution"});
  expect_refused(small_config({{"outputs", {{"trace", 1}}}}), {"$.outputs.trace"});
  expect_refused(small_config(), {"--set", "cuont", "'count'"}, {"--set", "lights.cuont=3"});
}

TEST(Usage, ImpossibleValues) {
  auto clustered = [](const json& parameters) {
    json algorithm = {{"name", "clustered"}};
    algorithm.update(parameters);
    return small_config({{"algorithms", {algorithm}}});
  };
  expect_refused(clustered({{"tile", 0}}), {"$.algorithms[0].tile"});
  expect_refused(clustered({{"slices", 0}}), {"$.algorithms[0].slices"});
  expect_refused(clustered({{"zmin", 10}, {"zmax", 5}}), {"zmax"});
  expect_refused(small_config({{"lights", {{"radius", -1}}}}), {"$.lights.radius"});
  expect_refused(small_config({{"lights", {{"count", 1048577}}}}), {"$.lights.count", "1048576"});
  expect_refused(small_config({{"lights", {{"count", -1}}}}), {"$.lights.count"});
  expect_refused(small_config({{"camera", {{"frames", 0}}}}), {"$.camera.frames"});
  expect_refused(small_config({{"resolution", {0, 27}}}), {"$.resolution[0]"});
  expect_refused(small_config({{"resolution", {32769, 27}}}), {"$.resolution[0]", "32768"});
  expect_refused(small_config({{"measure", {{"repeats", 0}}}}), {"$.measure.repeats"});
  expect_refused(small_config({{"camera", {{"path", "no such path"}}}}), {"no such path"});
  expect_refused(small_config({{"outputs", {{"images", {2}}}}}), {"$.outputs.images"});
}

TEST(Usage, DocumentsThatAreNoConfigurations) {
  Folder folder;
  const std::string file = (folder / "config.json").string();
  for (const std::string text :
       {"", "{", "[]", "{\"name\": \"a\", \"name\": \"b\"}", "{\"name\": 1e999}", "\xff\xfe"}) {
    write_text(file, text);
    expect_error(manylights({"run", file, "--out", (folder / "out").string()}), 2, {"config.json"});
  }
  expect_error(manylights({"run", (folder / "missing.json").string()}), 2, {"missing.json"});
  expect_error(manylights({"run", folder.path().string()}), 2, {folder.path().filename().string()});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Usage, UnknownDeviceAndNoVulkan) {
  Folder folder;
  const std::string config = write_config(folder, small_config()), out = (folder / "out").string();
  expect_error(manylights({"run", config, "--out", out, "--device", "no such device"}), 3,
               {"no Vulkan device matches 'no such device'", "0: "});
  ProcessOptions chosen, none;
  chosen.environment = {{"MANYLIGHTS_DEVICE", "77"}};
  none.environment = {{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}};
  expect_error(manylights({"run", config, "--out", out}, chosen), 3, {"'77'"});
  expect_error(manylights({"run", config, "--out", out}, none), 3, {"no Vulkan device"});
  expect_error(manylights({"verify", config}, none), 3, {"no Vulkan device"});
  expect_error(manylights({"render", config, "--frame", "0", "--out", (folder / "f.exr").string()}, none), 3,
               {"no Vulkan device"});
  expect_error(manylights({"doctor"}, none), 3, {"no Vulkan device"});
  expect_error(manylights({"list", "devices"}, none), 3, {"no Vulkan device"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "result.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "f.exr"));
}

TEST(Usage, PictureLargerThanTheDevicesImages) {
  Folder folder;
  const std::string config = write_config(folder, small_config({{"resolution", {32768, 4}}}));
  Outcome run = manylights({"run", config, "--out", (folder / "out").string(), "--quiet"});
  if (run.code == 0) GTEST_SKIP() << "this device has images of 32768 px a side";
  expect_error(run, 3, {"32768x4 px", "images of 1 to "});
  expect_error(manylights({"render", config, "--frame", "0", "--out", (folder / "f.exr").string()}), 3,
               {"32768x4 px", "images of 1 to "});
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "result.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "f.exr"));
}

TEST(Usage, FoldersThatCannotBeWritten) {
  Folder folder;
  const std::string config = write_config(folder, small_config());
  write_text(folder / "file", "no folder");
  for (const std::string& out :
       {(folder / "file").string(), (folder / "file").string() + "/below", std::string("/proc/manylights")}) {
    expect_error(manylights({"run", config, "--out", out}), 3, {out});
    expect_error(manylights({"render", config, "--frame", "0", "--out", out + "/f.exr"}), 3, {out});
  }
  expect_error(manylights({"scene", "plane", "--out", (folder / "file").string() + "/a.glb"}), 3, {"a.glb"});
  EXPECT_EQ(text_of(folder / "file"), "no folder");
}

TEST(Usage, DiskThatIsFull) {
  if (on_swiftshader()) GTEST_SKIP() << "SwiftShader keeps its code in a file that may not grow either";
  // Files may not grow beyond 1 KiB, which no result fits in.
  Folder folder;
  ProcessOptions full;
  full.largest_file = 1024;
  const std::string config = write_config(folder, small_config());
  Outcome run = manylights({"run", config, "--out", (folder / "out").string(), "--quiet"}, full);
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.error.find("manylights: cannot write "), std::string::npos) << run.error;
  EXPECT_NE(run.error.find("result.json"), std::string::npos) << run.error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
    ADD_FAILURE() << entry.path() << " was left behind";
  expect_error(manylights({"scene", "plane", "--out", (folder / "a.glb").string()}, full), 3, {"a.glb"});
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

}  // namespace
}  // namespace ml::test
