#include <cmath>
#include <limits>

#include "decode_png.h"
#include "files.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/output/picture.h"

namespace {

using namespace ml;

Picture greys(const std::vector<float>& values) {
  Picture picture(static_cast<uint32_t>(values.size()), 1, {"Y"});
  picture.data = values;
  return picture;
}

TEST(Png, AnotherDecoderReadsTheSamePixels) {
  Folder folder;
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 1}, {1, 9}, {9, 1}, {33, 17}, {200, 100}};
  for (auto [width, height] : sizes) {
    // Half noise, half a ramp, so that all row filters are used.
    std::vector<uint8_t> rgb(size_t{3} * width * height);
    Random random(width);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<uint8_t>(i % 2 ? random.next() : i / 7);
    for (size_t i = 0; i < rgb.size() / 2; ++i) rgb[i] = static_cast<uint8_t>(i / 3);
    write_png(width, height, rgb, folder / "a.png", "how it was made\nline 2");
    DecodedPng back = decode_png(folder / "a.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, rgb);
    EXPECT_EQ(png_description(folder / "a.png"), "how it was made\nline 2");
  }
}

TEST(Png, TextThatIsNotAsciiStaysReadable) {
  Folder folder;
  write_png(1, 1, {1, 2, 3}, folder / "a.png", "caf\xc3\xa9 \x01");
  EXPECT_EQ(png_description(folder / "a.png"), "caf?? ?");
}

TEST(Png, UnwritableIsASystemError) {
  EXPECT_THROW(write_png(1, 1, {1, 2, 3}, "/nowhere/a.png"), SystemError);
}

TEST(Preview, BrighterIsNeverDarker) {
  Folder folder;
  std::vector<float> values;
  for (int i = 0; i < 300; ++i) values.push_back(std::exp2(static_cast<float>(i) / 10 - 20));
  write_preview_png(greys(values), folder / "a.png");
  DecodedPng png = decode_png(folder / "a.png");
  for (uint32_t x = 1; x < png.width; ++x) EXPECT_GE(png.at(x, 0).r, png.at(x - 1, 0).r);
  EXPECT_EQ(png.at(png.width - 1, 0), (Color{255, 255, 255}));
}

TEST(Preview, FollowsTheStatedCurve) {
  Folder folder;
  std::vector<float> values{0, 0.01f, 0.1f, 0.5f, 1, 2, 3, 4, 5};
  const float white = 4;
  write_preview_png(greys(values), folder / "a.png", {.exposure = 1, .white = white});
  DecodedPng png = decode_png(folder / "a.png");
  for (uint32_t i = 0; i < values.size(); ++i) {
    double x = values[i], mapped = std::min(1.0, x * (1 + x / (white * white)) / (1 + x));
    double code = mapped <= 0.0031308 ? 12.92 * mapped : 1.055 * std::pow(mapped, 1 / 2.4) - 0.055;
    EXPECT_NEAR(png.at(i, 0).g, 255 * code, 0.5001) << x;
  }
  EXPECT_EQ(png.at(7, 0).g, 255) << "white maps to 1";
}

TEST(Preview, ExposureComesFromThePictureSoItsUnitDoesNotMatter) {
  Folder folder;
  Picture picture(30, 20, {"R", "G", "B"});
  Random random(5);
  for (float& value : picture.data) value = random.uniform(0, 3);
  float exposure = write_preview_png(picture, folder / "a.png");
  for (float& value : picture.data) value *= 1024;
  EXPECT_EQ(write_preview_png(picture, folder / "b.png") * 1024, exposure);
  EXPECT_EQ(decode_png(folder / "a.png").rgb, decode_png(folder / "b.png").rgb);
}

TEST(Preview, NeitherFirefliesNorDarknessMoveTheExposure) {
  Folder folder;
  std::vector<float> values(1000, 2.0f);
  float plain = write_preview_png(greys(values), folder / "a.png");
  EXPECT_FLOAT_EQ(plain, 2.0f) << "the 99th percentile, 2, becomes white, 4";
  values[3] = 1e30f, values[4] = std::numeric_limits<float>::infinity(), values[5] = std::nanf("");
  EXPECT_EQ(write_preview_png(greys(values), folder / "a.png"), plain);
  values.resize(100000, 0.0f);
  EXPECT_EQ(write_preview_png(greys(values), folder / "a.png"), plain);
}

TEST(Preview, ShowsWhatIsNoNumber) {
  Folder folder;
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  Picture picture(5, 1, {"R", "G", "B"});
  picture.data = {nan, 0, 0, infinity, 0, 0, infinity, nan, 0, -1, -1, -1, 1, 1, 1};
  write_preview_png(picture, folder / "a.png");
  DecodedPng png = decode_png(folder / "a.png");
  EXPECT_EQ(png.at(0, 0), (Color{255, 0, 255}));
  EXPECT_EQ(png.at(1, 0), (Color{255, 255, 255}));
  EXPECT_EQ(png.at(2, 0), (Color{255, 0, 255}));
  EXPECT_EQ(png.at(3, 0), (Color{0, 0, 0}));
}

TEST(Preview, BlackStaysBlackAndTheCurveIsStated) {
  Folder folder;
  EXPECT_EQ(write_preview_png(Picture(3, 2, {"R", "G", "B"}), folder / "a.png"), 1.0f);
  EXPECT_EQ(decode_png(folder / "a.png").rgb, std::vector<uint8_t>(18, 0));
  EXPECT_EQ(png_description(folder / "a.png"), ToneCurve{}.describe(1.0f));
  EXPECT_TRUE(contains(ToneCurve{.white = 2.5f}.describe(0.125f), "0.125"));
  EXPECT_TRUE(contains(ToneCurve{.white = 2.5f}.describe(0.125f), "2.5"));
}

}  // namespace
