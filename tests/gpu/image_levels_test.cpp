// Levels of images: one of them written out of another, and all of them read.
#include <gtest/gtest.h>

#include "harness/base/random.h"
#include "spirv/lookup.h"
#include "spirv/lookup_fetch.h"
#include "spirv/max_level_comp.h"
#include "tests/gpu/pictures.h"

namespace ml::test {
namespace {

using gpu::Format;
using gpu::ImageUse;

class ImageLevels : public DeviceTest {
 protected:
  gpu::Commands commands_{device()};
};

struct Picture {
  uint32_t width, height;
  std::vector<float> pixels;
};

// The largest of what each pixel of the coarser level lies over, found from the finer one's side.
Picture coarser(const Picture& fine) {
  Picture coarse{std::max(fine.width / 2, 1u), std::max(fine.height / 2, 1u), {}};
  coarse.pixels.assign(size_t{coarse.width} * coarse.height, -1);
  for (uint32_t y = 0; y < fine.height; ++y)
    for (uint32_t x = 0; x < fine.width; ++x) {
      float& max_value =
          coarse
              .pixels[std::min(y / 2, coarse.height - 1) * coarse.width + std::min(x / 2, coarse.width - 1)];
      max_value = std::max(max_value, fine.pixels[y * fine.width + x]);
    }
  return coarse;
}

Picture random_picture(uint32_t width, uint32_t height) {
  Random random(width);
  Picture picture{width, height, std::vector<float>(size_t{width} * height)};
  for (float& pixel : picture.pixels) pixel = random.uniform();
  return picture;
}

TEST_F(ImageLevels, APyramidIsBuiltLevelByLevel) {
  const gpu::ComputeProgram program(device(), max_level_comp, "max level"),
      fetch(device(), lookup_fetch, "fetch");
  for (const auto& [width, height, levels] :
       {std::array{37u, 21u, 3u}, {64u, 1u, gpu::all_levels}, {5u, 255u, gpu::all_levels}, {1u, 1u, 1u}}) {
    const gpu::Image image(device(),
                           {.width = width,
                            .height = height,
                            .format = Format::r32_float,
                            .use = ImageUse::storage,
                            .levels = levels},
                           "pyramid");
    Picture picture = random_picture(width, height);
    const gpu::Buffer staging = uploaded(std::span<const float>(picture.pixels), "pixels");
    const gpu::Image source(device(), width, height, Format::r32_float, ImageUse::storage, "source");
    commands_.begin(gpu::Timing::none);
    commands_.write_image(staging, source);
    // The first level is the maximum of one image's pixels, the others are those of the level before.
    const gpu::Buffer back(device(), image.bytes(), gpu::MemoryKind::readback, "back");
    commands_.clear(image);
    for (uint32_t level = 1; level < image.levels(); ++level)
      commands_.dispatch(
          program,
          {level == 1 ? gpu::Binding("finer", source) : gpu::Binding("finer", image, level - 1),
           {"coarser", image, level}},
          std::span<const std::byte>(), (image.width(level) + 7) / 8, (image.height(level) + 7) / 8);
    commands_.submit();
    std::vector<Query> queries;
    std::vector<float> expected;
    EXPECT_EQ(read<float>(commands_, image, 0), std::vector<float>(picture.pixels.size(), 0));
    for (uint32_t level = 1; level < image.levels(); ++level) {
      picture = coarser(picture);
      ASSERT_EQ(picture.width, image.width(level));
      ASSERT_EQ(picture.height, image.height(level));
      EXPECT_EQ(read<float>(commands_, image, level), picture.pixels) << "level " << level;
      for (uint32_t i = 0; i < picture.pixels.size(); ++i) {
        queries.push_back({{i % picture.width, i / picture.width}, 0, static_cast<float>(level)});
        expected.push_back(picture.pixels[i]);
      }
    }
    if (queries.empty()) continue;
    const auto seen = look_up<glm::vec4>(commands_, fetch, {"picture", image}, queries);
    for (size_t i = 0; i < seen.size(); ++i)
      ASSERT_EQ(seen[i].r, expected[i]) << "level " << queries[i].level;
  }
}

TEST_F(ImageLevels, SamplersTakeTheLevelThatIsAskedFor) {
  const gpu::ComputeProgram lookup_program(device(), lookup, "lookup");
  const gpu::Image image(device(),
                         {.width = 8,
                          .height = 8,
                          .format = Format::r32_float,
                          .use = ImageUse::storage,
                          .levels = gpu::all_levels},
                         "levels");
  ASSERT_EQ(image.levels(), 4u);
  EXPECT_EQ(image.bytes(), (64u + 16 + 4 + 1) * 4);
  // Each level is its number, and 10.
  std::vector<float> pixels;
  for (uint32_t level = 0; level < 4; ++level)
    pixels.insert(pixels.end(), image.bytes(level) / 4, 10.0f + static_cast<float>(level));
  write(commands_, image, pixels);
  const std::vector<Query> queries{{{0.5f, 0.5f}, 0, 0},
                                   {{0.1f, 0.9f}, 0, 1},
                                   {{0.7f, 0.2f}, 0, 2.4f},
                                   {{0.5f, 0.5f}, 0, 3},
                                   {{0.5f, 0.5f}, 0, 9}};
  const std::vector<float> all{10, 11, 12, 13, 13};
  auto reds = [&](const gpu::Binding& binding) {
    std::vector<float> list;
    for (const glm::vec4& answer : look_up<glm::vec4>(commands_, lookup_program, binding, queries))
      list.push_back(answer.r);
    return list;
  };
  EXPECT_EQ(reds({"picture", image}), all);
  EXPECT_EQ(reds({"picture", image, gpu::Sampling::nearest()}), all);
  // One level alone is all that the shader sees.
  EXPECT_EQ(reds({"picture", image, 2}), std::vector<float>(5, 12));
}

TEST_F(ImageLevels, ThatThereCannotBeAreErrors) {
  auto make = [](Format format, ImageUse use, uint32_t levels) {
    gpu::Image(device(), {.width = 8, .height = 5, .format = format, .use = use, .levels = levels}, "image");
  };
  make(Format::r32_float, ImageUse::storage, 4);
  EXPECT_THROW(make(Format::r32_float, ImageUse::storage, 5), std::logic_error);
  EXPECT_THROW(make(Format::r32_float, ImageUse::storage, 0), std::logic_error);
  EXPECT_THROW(make(Format::d32_float, ImageUse::attachment, 2), std::logic_error);
  const gpu::Image image(device(), {.width = 8, .height = 5, .format = Format::r32_float, .levels = 2},
                         "image");
  const gpu::Image plain(device(), 8, 5, Format::r32_float, ImageUse::storage, "plain");
  const gpu::Buffer back(device(), image.bytes(), gpu::MemoryKind::readback, "back");
  const gpu::ComputeProgram program(device(), max_level_comp, "max level");
  commands_.begin(gpu::Timing::none);
  EXPECT_THROW(commands_.read_image(image, back, 2), std::logic_error);
  try {
    commands_.dispatch(program, {{"finer", plain, 0}, {"coarser", image, 2}}, std::span<const std::byte>(),
                       1);
    ADD_FAILURE() << "no error";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "max level: level 2 of 'coarser', which has 2");
  }
  commands_.submit();
}

}  // namespace
}  // namespace ml::test
