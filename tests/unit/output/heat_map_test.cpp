#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "decode_png.h"
#include "files.h"
#include "harness/output/picture.h"
#include "harness/output/ticks.h"

namespace {

using namespace ml;

Picture map_of(uint32_t width, uint32_t height, const std::vector<float>& values) {
  Picture picture(width, height, {"Y"});
  for (size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = values[i % values.size()];
  return picture;
}

int brightness(Color color) {
  return 2126 * color.r + 7152 * color.g + 722 * color.b;
}

TEST(ColorScale, SrgbBytesAreThoseOfTheStandard) {
  for (int i = 0; i < 256; ++i) {
    double code = i / 255.0, linear = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    EXPECT_EQ(srgb_byte(linear), i);
  }
  EXPECT_EQ(srgb_byte(-1), 0);
  EXPECT_EQ(srgb_byte(7), 255);
  EXPECT_EQ(srgb_byte(std::nan("")), 0);
}

TEST(ColorScale, GetsSteadilyBrighterInSmallSteps) {
  for (int i = 1; i < 256; ++i) {
    Color before = scale_color((i - 1) / 255.0), here = scale_color(i / 255.0);
    EXPECT_GE(brightness(here), brightness(before)) << i;
    if (i >= 2) {  // neighbours may round to the same bytes
      EXPECT_GT(brightness(here), brightness(scale_color((i - 2) / 255.0))) << i;
    }
    EXPECT_LE(std::abs(here.r - before.r) + std::abs(here.g - before.g) + std::abs(here.b - before.b), 8)
        << i;
  }
  EXPECT_EQ(scale_color(-1), scale_color(0));
  EXPECT_EQ(scale_color(2), scale_color(1));
  EXPECT_EQ(scale_color(std::nan("")), scale_color(0));
}

TEST(ColorScale, ZeroAndNoValueAreNoColoursOfTheScale) {
  auto distance = [](Color a, Color b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  };
  for (int i = 0; i < 256; ++i) {
    EXPECT_GT(distance(scale_color(i / 255.0), zero_color), 120);
    EXPECT_GT(distance(scale_color(i / 255.0), no_value_color), 90);
  }
}

TEST(Ticks, AreRoundMultiplesThatFitBesideEachOther) {
  auto width = [](const std::string& label) { return 12.0 * static_cast<double>(label.size()) + 10; };
  for (double end : {1.0, 2.0, 3.0, 7.0, 10.0, 37.0, 50.0, 99.0, 100.0, 979.0, 65536.0, 0.02, 0.37, 1.5,
                     12345.6, 3e9, 1e-8}) {
    for (bool integers : {true, false}) {
      if (integers && end != std::floor(end)) continue;
      for (double length : {10.0, 120.0, 400.0, 900.0, 8000.0}) {
        std::vector<double> ticks = scale_ticks(end, integers, length, width);
        EXPECT_TRUE(ticks.size() >= 2 || length < 400 || end < 7) << end;
        double free_from = 0;
        for (double value : ticks) {
          double at = value / end * length, half = width(tick_label(value, end)) / 2;
          EXPECT_GT(value, 0);
          EXPECT_LT(value, end);
          EXPECT_GE(at - half, free_from - 1e-9);
          free_from = at + half;
          EXPECT_TRUE(!integers || value == std::floor(value)) << value;
          EXPECT_EQ(tick_label(value, end), tick_label(std::stod(tick_label(value, end)), end))
              << "the label says the value";
          EXPECT_NEAR(std::stod(tick_label(value, end)), value, 1e-3 * value);
        }
        if (ticks.empty()) continue;
        EXPECT_LE(free_from, length - width(tick_label(end, end)) / 2 + 1e-9);
      }
    }
  }
}

TEST(HeatMap, MapIsPixelForPixelAndMonotone) {
  Folder folder;
  Picture picture(300, 200, {"Y"});
  for (uint32_t y = 0; y < 200; ++y)
    for (uint32_t x = 0; x < 300; ++x) picture.data[picture.pixel(x, y)] = static_cast<float>(x);
  write_heat_map_png(picture, folder / "a.png", {.title = "x"});
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.at(0, 100), zero_color);
  for (uint32_t x = 2; x < 300; ++x) EXPECT_GE(brightness(png.at(x, 100)), brightness(png.at(x - 1, 100)));
  EXPECT_EQ(png.at(150, 50), scale_color(150.0 / 299));
  EXPECT_EQ(png.at(299, 199), scale_color(1));
}

TEST(HeatMap, RingStandsAroundTheFirstMaximumAndLeavesItsPixelVisible) {
  Folder folder;
  Picture picture = map_of(400, 300, {1});
  picture.data[picture.pixel(200, 150)] = picture.data[picture.pixel(300, 150)] = 9;
  write_heat_map_png(picture, folder / "a.png", {.title = "x"});
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.at(200, 150), scale_color(1));
  Color background = scale_color(1.0 / 9), white{255, 255, 255};
  double nearest = 1e9, farthest = 0;
  for (uint32_t y = 0; y < 300; ++y)
    for (uint32_t x = 0; x < 400; ++x)
      if (png.at(x, y) != background && png.at(x, y) != scale_color(1)) {
        double distance = std::hypot(x - 200.0, y - 150.0);
        nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
      }
  EXPECT_GT(nearest, 2);
  EXPECT_LT(farthest, 30);
  bool has_white = false;
  for (uint32_t x = 180; x < 200; ++x) has_white |= png.at(x, 150) == white;
  EXPECT_TRUE(has_white);
  EXPECT_TRUE(contains(png_description(folder / "a.png"), "maximum 9 at pixel (200, 150)"));
}

TEST(HeatMap, MissingValuesAreGreyAndStrangeOnesMagenta) {
  Folder folder;
  Picture picture = map_of(40, 30, {1});
  picture.data[0] = -1, picture.data[1] = std::nanf(""),
  picture.data[2] = std::numeric_limits<float>::infinity();
  picture.data[picture.pixel(39, 29)] = 2;
  write_heat_map_png(picture, folder / "a.png", {.title = "x"});
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.at(0, 0), no_value_color);
  EXPECT_EQ(png.at(1, 0), not_finite_color);
  EXPECT_EQ(png.at(2, 0), not_finite_color);
  EXPECT_TRUE(contains(png_description(folder / "a.png"), "not finite: 2 pixels"));
  EXPECT_TRUE(contains(png_description(folder / "a.png"), "no value"));
}

TEST(HeatMap, GivenMaximumFixesTheColoursOfTwoMaps) {
  Folder folder;
  Picture low = map_of(60, 40, {5}), high = map_of(60, 40, {5});
  low.data.back() = 8, high.data.back() = 800;
  write_heat_map_png(low, folder / "low.png", {.title = "x", .maximum = 10});
  write_heat_map_png(high, folder / "high.png", {.title = "x", .maximum = 10});
  EXPECT_EQ(decode_png(folder / "low.png").at(10, 10), scale_color(0.5));
  EXPECT_EQ(decode_png(folder / "high.png").at(10, 10), scale_color(0.5));
  EXPECT_TRUE(contains(png_description(folder / "high.png"), "maximum 800"))
      << "the picture's own, not the scale's";
}

TEST(HeatMap, TilesAreBlownUp) {
  Folder folder;
  Picture picture = map_of(10, 6, {0, 1, 2, 3});
  picture.data[picture.pixel(9, 5)] = 4;
  write_heat_map_png(picture, folder / "a.png", {.title = "x", .block = 48});
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.width, 480u);
  for (uint32_t y : {0u, 47u})
    for (uint32_t x : {144u, 191u}) EXPECT_EQ(png.at(x, y), scale_color(3.0 / 4));
  EXPECT_TRUE(contains(png_description(folder / "a.png"), "maximum 4 at tile (9, 5)"));
}

TEST(HeatMap, ClassesHaveTheirOwnColoursAndShares) {
  Folder folder;
  Picture picture = map_of(100, 10, {0, 1, 1, 2, -1});
  write_heat_map_png(picture, folder / "a.png", {.title = "traversal", .classes = {"list", "tree", "mixed"}});
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.at(0, 0), class_colors[0]);
  EXPECT_EQ(png.at(1, 0), class_colors[1]);
  EXPECT_EQ(png.at(3, 0), class_colors[2]);
  EXPECT_EQ(png.at(4, 0), no_value_color);
  std::string text = png_description(folder / "a.png");
  for (const char* part : {"list 25.0 %", "tree 50.0 %", "mixed 25.0 %"})
    EXPECT_TRUE(contains(text, part)) << text;
}

TEST(HeatMap, AnySizeWorksAndSmallOnesGetAWiderCanvas) {
  Folder folder;
  for (auto [width, height] :
       std::vector<std::pair<uint32_t, uint32_t>>{{1, 1}, {1, 500}, {5000, 1}, {3000, 2000}}) {
    for (float value : {-1.0f, 0.0f, 3.0f, 1e-30f, 1e30f, std::nanf("")}) {
      write_heat_map_png(map_of(width, height, {value}), folder / "a.png",
                         {.title = "some quantity", .unit = "ms"});
      DecodedPng png = decode_png(folder / "a.png");
      EXPECT_GE(png.width, std::max(width, 300u));
      EXPECT_GT(png.height, height + 40);
    }
  }
}

TEST(HeatMap, LegendHasInkAndEndsInsideTheCanvas) {
  Folder folder;
  write_heat_map_png(map_of(1, 1, {3}), folder / "a.png",
                     {.title = "a title that is rather longer than a small picture is wide, so"});
  DecodedPng png = decode_png(folder / "a.png");
  Color paper = png.at(png.width - 1, png.height - 1);
  std::set<uint32_t> columns;
  for (uint32_t y = 2; y < png.height; ++y)
    for (uint32_t x = 0; x < png.width; ++x)
      if (png.at(x, y) != paper) columns.insert(x);
  EXPECT_GT(columns.size(), png.width / 2);
  EXPECT_GE(png.width - *columns.rbegin(), 4u) << "nothing runs out of the canvas";
}

TEST(HeatMap, RefusesWhatItCannotDraw) {
  Folder folder;
  EXPECT_THROW(write_heat_map_png(Picture(2, 2, {"R", "G", "B"}), folder / "a.png", {}),
               std::invalid_argument);
  EXPECT_THROW(write_heat_map_png(Picture(2, 2, {"Y"}), folder / "a.png",
                                  {.classes = std::vector<std::string>(9, "x")}),
               std::invalid_argument);
  EXPECT_THROW(write_heat_map_png(Picture(16384, 1, {"Y"}), folder / "a.png", {.block = 64}),
               std::invalid_argument);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
