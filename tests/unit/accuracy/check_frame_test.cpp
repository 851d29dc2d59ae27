// scripts/check_frame.py on frames that the oracle made: it must agree, and see every kind of lie.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "harness/accuracy/oracle.h"
#include "harness/base/random.h"
#include "harness/output/lights_csv.h"
#include "harness/output/picture.h"

namespace {

using namespace ml;

constexpr uint32_t width = 150, height = 35;

// A bumpy floor under random lights, sky above.
struct Frame {
  Picture position{width, height, {"X", "Y", "Z"}}, normal{width, height, {"X", "Y", "Z"}},
      albedo{width, height, {"R", "G", "B"}};
  Picture depth{width, height, {"Y"}}, contributing{width, height, {"Y"}}, listed{width, height, {"Y"}};
  std::vector<LightRow> lights;

  Frame() {
    Random random(8);
    std::vector<OracleLight> oracle_lights;
    for (int i = 0; i < 700; ++i) {
      LightRow row;
      row.position[0] = random.uniform(-20, 20), row.position[1] = random.uniform(-3, 1),
      row.position[2] = random.uniform(-30, -2);
      row.radius = random.uniform(0.5f, 6);
      static const char* const shapes[] = {"omni", "spot", "capsule", "wedge", "box"};
      row.shape = shapes[i % 5];
      const bool segment = i % 5 == 2 || i % 5 == 3, box = i % 5 == 4;
      if (row.shape == "spot" || row.shape == "wedge") {
        float x = random.uniform(-0.5f, 0.5f), y = -std::sqrt(1 - x * x);
        row.direction[0] = x, row.direction[1] = y;
        row.cos_outer = random.uniform(0.3f, 0.95f);
        row.cone_limit = 1 - row.cos_outer, row.cone_scale = 2 / row.cone_limit;
      }
      if (segment || box) row.side[2] = random.below(2) ? 1 : -1;  // across the direction
      if (segment) row.half_length = random.uniform(0, 4);
      if (box) {
        row.direction[0] = 0.6f, row.direction[1] = -0.8f;
        for (float& extent : row.half_extents) extent = random.uniform(0.4f, 4);
      }
      row.probe = i % 7 == 2;
      lights.push_back(row);
      oracle_lights.push_back(
          {.position = {row.position[0], row.position[1], row.position[2]},
           .radius = row.radius,
           .spot = row.shape == "spot" || row.shape == "wedge",
           .direction = {row.direction[0], row.direction[1], row.direction[2]},
           .cone_scale = row.cone_scale,
           .cone_limit = row.cone_limit,
           .side = {row.side[0], row.side[1], row.side[2]},
           .half_length = row.half_length,
           .box = box,
           .half_extents = {row.half_extents[0], row.half_extents[1], row.half_extents[2]},
           .probe = row.probe});
    }
    for (uint32_t y = height / 3; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        float z = -60.0f / (static_cast<float>(y - height / 3) + 2), bump = random.uniform(-0.2f, 0.2f);
        size_t p = position.pixel(x, y), d = depth.pixel(x, y);
        float at[3] = {(static_cast<float>(x) / width - 0.5f) * -z, -2 + bump, z},
              up = std::sqrt(1 - bump * bump);
        float facing[3] = {bump, up, 0};
        for (size_t k = 0; k < 3; ++k)
          position.data[p + k] = at[k], normal.data[p + k] = facing[k], albedo.data[p + k] = 0.5f;
        depth.data[d] = -z;
        SurfacePoint point{.position = {at[0], at[1], at[2]}, .normal = {facing[0], facing[1], facing[2]}};
        contributing.data[d] = static_cast<float>(oracle_shade(point, oracle_lights, false).contributing);
        listed.data[d] = contributing.data[d] + 2;
      }
    }
  }
};

int run_script(const Frame& frame, const std::string& options = "", const std::string& remove = "") {
  std::string folder = (std::filesystem::temp_directory_path() / "manylights-frame-XXXXXX").string();
  if (!mkdtemp(folder.data())) return -1;
  std::string stem = folder + "/frame";
  write_exr(frame.position, stem + ".position.exr");
  write_exr(frame.normal, stem + ".normal.exr");
  write_exr(frame.albedo, stem + ".albedo.exr");
  write_exr(frame.depth, stem + ".depth.exr");
  write_exr(frame.contributing, stem + ".contributing.exr");
  write_exr(frame.listed, stem + ".listed.exr");
  write_lights_csv(frame.lights, stem + ".csv");
  if (!remove.empty()) std::filesystem::remove(stem + remove);
  std::string command = std::string(ML_SOURCE_DIR "/scripts/check_frame.py ") + options + " " + stem + " " +
                        stem + ".csv > /dev/null 2>&1";
  int status = std::system(command.c_str());
  std::filesystem::remove_all(folder);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class CheckFrame : public testing::Test {
 protected:
  void SetUp() override {
    if (access("/usr/bin/python3", X_OK) != 0) GTEST_SKIP() << "/usr/bin/python3 is not installed";
  }
};

TEST_F(CheckFrame, AgreesWithTheOracle) {
  Frame frame;
  float max_count = 0;
  for (float count : frame.contributing.data) max_count = std::max(max_count, count);
  ASSERT_GT(max_count, 3) << "the frame must be worth checking";
  EXPECT_EQ(run_script(frame), 0);
  EXPECT_EQ(run_script(frame, "--step 3"), 0);
}

TEST_F(CheckFrame, SeesEveryKindOfLie) {
  const std::pair<const char*, std::function<void(Frame&)>> lies[] = {
      {"one light too many at one pixel",
       [](Frame& f) { f.contributing.data.back() += 1, f.listed.data.back() += 1; }},
      {"one light too few somewhere",
       [](Frame& f) {
         for (float& count : f.contributing.data)
           if (count > 0) {
             count -= 1;
             return;
           }
       }},
      {"lights in the sky", [](Frame& f) { f.contributing.data[0] = f.listed.data[0] = 1; }},
      {"a list that is too short", [](Frame& f) { f.listed.data.back() = -1; }},
      {"a normal that is not of unit length",
       [](Frame& f) { f.normal.data[f.normal.pixel(7, height - 1) + 1] = 2; }},
      {"an impossible albedo", [](Frame& f) { f.albedo.data.back() = 1.5f; }},
      {"a NaN position", [](Frame& f) { f.contributing.data.back() = std::nanf(""); }},
      {"lights that moved",
       [](Frame& f) {
         for (LightRow& row : f.lights) row.position[1] += 0.5f;
       }},
      {"a shape that is another",
       [](Frame& f) {
         for (LightRow& row : f.lights)
           if (row.shape == "capsule") row.shape = "box";
       }},
      {"segments that are longer",
       [](Frame& f) {
         for (LightRow& row : f.lights) row.half_length *= 1.5f;
       }},
      {"boxes that are larger",
       [](Frame& f) {
         for (LightRow& row : f.lights) row.half_extents[2] *= 1.5f;
       }},
  };
  for (const auto& [what, tell] : lies) {
    Frame frame;
    tell(frame);
    EXPECT_EQ(run_script(frame), 1) << what;
  }
}

TEST_F(CheckFrame, MissingFilesAreUsageErrors) {
  Frame frame;
  for (const char* name : {".position.exr", ".normal.exr", ".depth.exr", ".contributing.exr", ".csv"})
    EXPECT_EQ(run_script(frame, "", name), 2) << name;
  EXPECT_EQ(run_script(frame, "", ".listed.exr"), 0);
  EXPECT_EQ(run_script(frame, "--step 0"), 2);
}

}  // namespace
