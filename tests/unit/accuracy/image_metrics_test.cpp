#include "harness/accuracy/image_metrics.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "harness/base/random.h"

namespace {

using namespace ml;

Picture random_picture(uint32_t width, uint32_t height, uint64_t seed) {
  Picture picture(width, height, {"R", "G", "B"});
  Random random(seed);
  for (float& value : picture.data) value = random.uniform(0, 4);
  return picture;
}

TEST(CompareImages, APictureEqualsItself) {
  Picture picture = random_picture(31, 17, 1);
  ImageDifference same = compare_images(picture, picture);
  EXPECT_EQ(same.max_relative, 0);
  EXPECT_EQ(same.rel_mse, 0);
  EXPECT_EQ(same.rmse, 0);
  EXPECT_EQ(same.not_finite, 0u);
  EXPECT_EQ(same.differing_bits, 0u);
}

TEST(CompareImages, OneChangedPixelIsFoundAndMeasured) {
  Picture b(10, 10, {"R", "G", "B"});
  for (float& value : b.data) value = 2;
  Picture a = b;
  a.data[a.pixel(3, 7) + 1] = 2.5f;
  ImageDifference difference = compare_images(a, b);
  EXPECT_DOUBLE_EQ(difference.max_relative, 0.25);
  EXPECT_EQ(difference.worst_x, 3u);
  EXPECT_EQ(difference.worst_y, 7u);
  EXPECT_EQ(difference.differing_bits, 1u);
  EXPECT_NEAR(difference.rmse, 0.5 / std::sqrt(300.0), 1e-12);
  EXPECT_NEAR(difference.rel_mse, 0.25 / (4 + 0.04) / 300, 1e-12);
}

TEST(CompareImages, RelativeMeasuresDoNotDependOnTheUnit) {
  Picture a = random_picture(20, 20, 2), b = random_picture(20, 20, 3);
  ImageDifference before = compare_images(a, b);
  for (Picture* picture : {&a, &b})
    for (float& value : picture->data) value *= 4096;
  ImageDifference after = compare_images(a, b);
  EXPECT_DOUBLE_EQ(after.max_relative, before.max_relative);
  EXPECT_DOUBLE_EQ(after.rel_mse, before.rel_mse);
  EXPECT_DOUBLE_EQ(after.rmse, 4096 * before.rmse);
}

TEST(CompareImages, PixelsWithoutANumberAreCountedAndLeftOut) {
  Picture a = random_picture(20, 10, 4), b = random_picture(20, 10, 5);
  Picture clean_a = a, clean_b = b;
  a.data[a.pixel(0, 0)] = std::nanf("");
  b.data[b.pixel(1, 0) + 2] = std::numeric_limits<float>::infinity();
  a.data[a.pixel(2, 0) + 1] = b.data[b.pixel(2, 0) + 1] = std::nanf("");
  ImageDifference difference = compare_images(a, b);
  EXPECT_EQ(difference.not_finite, 3u);
  // The rest alone: the same pictures with these pixels cut away.
  auto cut = [](Picture picture) {
    picture.data.erase(picture.data.begin(), picture.data.begin() + 9);
    picture.width = 197, picture.height = 1;
    return picture;
  };
  ImageDifference rest = compare_images(cut(clean_a), cut(clean_b));
  EXPECT_DOUBLE_EQ(difference.rmse, rest.rmse);
  EXPECT_DOUBLE_EQ(difference.rel_mse, rest.rel_mse);
  EXPECT_DOUBLE_EQ(difference.max_relative, rest.max_relative);
}

TEST(CompareImages, NothingButNansIsNoDifferenceAndNoNan) {
  Picture picture(2, 2, {"Y"});
  for (float& value : picture.data) value = std::nanf("");
  ImageDifference difference = compare_images(picture, picture);
  EXPECT_EQ(difference.not_finite, 4u);
  EXPECT_EQ(difference.differing_bits, 0u);
  EXPECT_EQ(difference.rmse, 0);
  EXPECT_EQ(difference.rel_mse, 0);
}

TEST(CompareImages, BitsDifferWhereNumbersDoNot) {
  Picture a(1, 1, {"Y"}), b(1, 1, {"Y"});
  a.data[0] = -0.0f;
  EXPECT_EQ(compare_images(a, b).differing_bits, 1u);
  EXPECT_EQ(compare_images(a, b).max_relative, 0);
}

TEST(CompareImages, TheFloorLimitsWhatDarkPixelsCanSay) {
  Picture b(100, 1, {"Y"});
  for (float& value : b.data) value = 1;
  b.data[0] = 0;
  Picture a = b;
  a.data[0] = 1e-3f;
  EXPECT_NEAR(compare_images(a, b, 0.1).max_relative, 1e-2, 1e-8);
  EXPECT_NEAR(compare_images(a, b).max_relative, 1e-3 / (1e-4 * 0.99), 1e-5);
  Picture black(100, 1, {"Y"});
  EXPECT_NEAR(compare_images(a, black).max_relative, 1, 1e-12) << "against black: the difference itself";
  EXPECT_TRUE(std::isfinite(compare_images(a, black).rel_mse));
  EXPECT_GT(compare_images(a, black).rel_mse, 0);
}

TEST(CompareImages, RefusesPicturesThatDoNotMatch) {
  EXPECT_THROW(compare_images(Picture(2, 2, {"Y"}), Picture(2, 3, {"Y"})), std::invalid_argument);
  EXPECT_THROW(compare_images(Picture(2, 2, {"Y"}), Picture(2, 2, {"Z"})), std::invalid_argument);
  EXPECT_THROW(compare_images(Picture(2, 2, {"Y"}), Picture(2, 2, {"Y"}), -1), std::invalid_argument);
  EXPECT_THROW(compare_images(Picture(2, 2, {"Y"}), Picture(2, 2, {"Y"}), std::nan("")),
               std::invalid_argument);
}

// OpenImageIO's idiff measures the same root mean square, on the files that we write.
TEST(CompareImages, AgreesWithIdiff) {
  if (std::system("command -v idiff > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "idiff (openimageio-tools) is not installed";
  std::string folder = (std::filesystem::temp_directory_path() / "manylights-idiff-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  Picture a = random_picture(64, 48, 6), b = random_picture(64, 48, 7);
  write_exr(a, folder + "/a.exr");
  write_exr(b, folder + "/b.exr");
  std::string output;
  FILE* pipe = popen(("idiff " + folder + "/a.exr " + folder + "/b.exr").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  pclose(pipe);
  std::filesystem::remove_all(folder);
  size_t at = output.find("RMS error = ");
  ASSERT_NE(at, std::string::npos) << output;
  double theirs = std::stod(output.substr(at + 12)), ours = compare_images(a, b).rmse;
  EXPECT_NEAR(ours, theirs, 1e-5 * ours) << output;
}

}  // namespace
