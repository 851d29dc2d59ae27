#include "harness/output/lights_csv.h"

#include <cmath>
#include <cstring>

#include "files.h"
#include "harness/base/error.h"
#include "harness/base/random.h"

namespace {

using namespace ml;

std::vector<LightRow> random_lights(size_t count) {
  Random random(3);
  auto finite = [&] {
    for (;;) {
      uint32_t bits = random.next();
      float value;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return value;
    }
  };
  std::vector<LightRow> lights(count);
  for (LightRow& light : lights) {
    for (float& value : light.position) value = finite();
    for (float& value : light.intensity) value = finite();
    for (float& value : light.direction) value = finite();
    light.radius = finite(), light.cone_scale = finite(), light.cone_limit = finite(),
    light.cos_outer = finite(), light.half_length = finite();
    for (float& value : light.side) value = finite();
    for (float& value : light.half_extents) value = finite();
    static const char* const shapes[] = {"omni", "spot", "capsule", "wedge", "box"};
    light.shape = shapes[random.below(5)];
    light.probe = random.below(2) == 0;
  }
  return lights;
}

bool same(const LightRow& a, const LightRow& b) {
  return std::memcmp(a.position, b.position, sizeof a.position) == 0 &&
         std::memcmp(a.intensity, b.intensity, sizeof a.intensity) == 0 &&
         std::memcmp(a.direction, b.direction, sizeof a.direction) == 0 && a.radius == b.radius &&
         a.cone_scale == b.cone_scale && a.cone_limit == b.cone_limit && a.cos_outer == b.cos_outer &&
         std::memcmp(a.side, b.side, sizeof a.side) == 0 && a.half_length == b.half_length &&
         std::memcmp(a.half_extents, b.half_extents, sizeof a.half_extents) == 0 && a.shape == b.shape &&
         a.probe == b.probe;
}

TEST(LightsCsv, EveryFloatComesBackBitForBit) {
  Folder folder;
  std::vector<LightRow> lights = random_lights(5000);
  write_lights_csv(lights, folder / "lights.csv");
  std::vector<LightRow> back = read_lights_csv(folder / "lights.csv");
  ASSERT_EQ(back.size(), lights.size());
  for (size_t i = 0; i < lights.size(); ++i) ASSERT_TRUE(same(lights[i], back[i])) << i;
}

TEST(LightsCsv, NoLightsIsAHeaderWithUnits) {
  Folder folder;
  write_lights_csv({}, folder / "lights.csv");
  std::string text = read_text_file(folder / "lights.csv");
  EXPECT_EQ(text.rfind("index,x [m],y [m],z [m],radius [m],intensity_r [W/sr]", 0), 0u);
  EXPECT_TRUE(read_lights_csv(folder / "lights.csv").empty());
}

TEST(LightsCsv, ErrorsNameFileAndLine) {
  Folder folder;
  write_lights_csv(random_lights(3), folder / "good.csv");
  const std::string good = read_text_file(folder / "good.csv");
  const size_t third_line = good.find('\n', good.find('\n') + 1) + 1;
  auto message = [&](const std::string& text) {
    write_file(folder / "bad.csv", text);
    return message_of<UsageError>([&] { read_lights_csv(folder / "bad.csv"); });
  };
  std::string missing_column = good, bad_number = good, bad_index = good, bad_shape = good;
  missing_column.erase(third_line, 2);
  bad_number[good.find(',', third_line) + 1] = 'x';
  bad_index[third_line] = '7';
  bad_shape.insert(good.find_first_of("oscwb", third_line), "x");
  for (const std::string& text : {missing_column, bad_number, bad_index, bad_shape}) {
    std::string found = message(text);
    EXPECT_TRUE(contains(found, "bad.csv: line 3: ")) << found;
  }
  EXPECT_TRUE(contains(message("hello\n"), "line 1"));
  EXPECT_TRUE(contains(message(""), "line 1"));
  EXPECT_TRUE(contains(message(good.substr(0, good.size() - 5)), "line 4"));
}

}  // namespace
