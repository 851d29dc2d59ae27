// list, render, verify and doctor.
#include <cmath>

#include "harness/output/lights_csv.h"
#include "harness/output/picture.h"
#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;

TEST(Commands, ListsAreJson) {
  for (const char* what : {"algorithms", "scenes", "configs", "devices", "metrics", "effects"}) {
    Outcome outcome = manylights({"list", what, "--json"});
    ASSERT_EQ(outcome.code, 0) << what << outcome.error;
    json list = json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(list.is_array()) << what;
    ASSERT_FALSE(list.empty()) << what;
    Outcome plain = manylights({"list", what});
    EXPECT_EQ(plain.code, 0);
    for (const json& item : list)
      EXPECT_NE(plain.out.find(item["name"].get<std::string>()), std::string::npos) << item;
  }
  json algorithms = json::parse(manylights({"list", "--json"}).out);
  for (const json& algorithm : algorithms)
    for (const json& parameter : algorithm["parameters"]) {
      EXPECT_TRUE(parameter.contains("default"));
      EXPECT_TRUE(parameter.contains("range") || parameter.contains("choices"));
      EXPECT_FALSE(parameter["help"].get<std::string>().empty());
    }
}

TEST(Commands, ARenderedFrameIsCheckedByAnotherProgram) {
  Folder folder;
  json config = small_config({{"scene", "canyon"},
                              {"resolution", {160, 90}},
                              {"algorithms", {"clustered"}},
                              {"lights", all_shapes(1500)}});
  const std::string stem = (folder / "frame").string();
  Outcome outcome = manylights({"render", write_config(folder, config), "--frame", "1", "--out",
                                stem + ".exr", "--aov", "all", "--lights", stem + ".csv", "--validation"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  Outcome checked =
      run_process({"/usr/bin/python3", ML_SOURCE_DIR "/scripts/check_frame.py", stem, stem + ".csv"});
  EXPECT_EQ(checked.code, 0) << checked.out << checked.error;

  Picture picture = read_exr(stem + ".exr"), depth = read_exr(stem + ".depth.exr");
  ASSERT_EQ(picture.width, 160u);
  ASSERT_EQ(picture.height, 90u);
  double sum = 0;
  for (float value : picture.data) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0);
    sum += static_cast<double>(value);
  }
  EXPECT_GT(sum, 0);
  EXPECT_EQ(read_lights_csv(stem + ".csv").size(), 1500u);
  // The script sees a lie: lights that are smaller than those of the picture.
  std::vector<LightRow> rows = read_lights_csv(stem + ".csv");
  for (LightRow& row : rows) row.radius *= 0.9f;
  write_lights_csv(rows, stem + ".less.csv");
  EXPECT_EQ(
      run_process({"/usr/bin/python3", ML_SOURCE_DIR "/scripts/check_frame.py", stem, stem + ".less.csv"})
          .code,
      1);
}

TEST(Commands, VerifyProvesTheSmokeConfiguration) {
  Outcome outcome = manylights(
      {"verify", "regression/smoke", "--frames", "1", "--brute-force", "3000000", "--validation", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("no light lost"), std::string::npos);
  EXPECT_NE(outcome.out.find("the validation layer has nothing to say"), std::string::npos);
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos);
}

// The scenes with long views, streets, fences and leaves, small: no algorithm loses a light in them.
TEST(Commands, VerifyProvesTheTownAndTheGrove) {
  for (const char* name : {"citadel", "grove"}) {
    Outcome outcome =
        manylights({"verify", name, "--set", "resolution=[160,90]", "--set", "camera.frames=3", "--set",
                    "lights.count=1024"});  // of frames that are asked for as pictures one is not there
    EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.out << outcome.error;
  }
}

TEST(Commands, DoctorDescribesTheDevice) {
  Outcome outcome = manylights({"doctor"});
  EXPECT_TRUE(outcome.code == 0 || outcome.code == 1) << outcome.error;  // 1: the clock of a busy machine
  EXPECT_FALSE(outcome.out.empty());
}

}  // namespace
}  // namespace ml::test
