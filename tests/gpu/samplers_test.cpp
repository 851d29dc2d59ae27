// Filters, edges and comparisons of samplers.
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "spirv/lookup.h"
#include "spirv/lookup_shadow.h"
#include "tests/gpu/pictures.h"

namespace ml::test {
namespace {

using gpu::Format;
using gpu::ImageUse;
using gpu::Sampling;

constexpr int width = 9, height = 6;
// Weights of a filter have 8 bits or so.
constexpr float filter_error = 1.0f / 128;

class Samplers : public DeviceTest {
 protected:
  gpu::Commands commands_{device()};
  const std::vector<float> pixels_ = [] {
    Random random(3);
    std::vector<float> list(width * height);
    for (float& pixel : list) pixel = static_cast<float>(random.below(1001)) / 1000;
    return list;
  }();
  // The nearest texel there is.
  float pixel(int x, int y) const {
    return pixels_[static_cast<size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
  }
};

// In texels: 0.5 is the centre of the first.
glm::vec2 at(float x, float y) {
  return {x / width, y / height};
}

TEST_F(Samplers, TakeOnePixelOrMixFour) {
  if (!supports(device(), Format::r32_float, ImageUse::texture, Sampling::linear()))
    GTEST_SKIP() << "the device does not filter 32-bit floats";
  const gpu::ComputeProgram program(device(), lookup, "lookup");
  const gpu::Image image(
      device(), {.width = width, .height = height, .format = Format::r32_float, .use = ImageUse::texture},
      "picture");
  write(commands_, image, pixels_);
  std::vector<Query> queries;
  // Beyond the edges too, where the edge goes on.
  for (int y = -2; y < height + 2; ++y)
    for (int x = -2; x < width + 2; ++x)
      queries.push_back({at(static_cast<float>(x) + 0.75f, static_cast<float>(y) + 1), 0, 0});
  const auto one = look_up<glm::vec4>(commands_, program, {"picture", image, Sampling::nearest()}, queries),
             four = look_up<glm::vec4>(commands_, program, {"picture", image, Sampling::linear()}, queries);
  for (size_t i = 0; i < queries.size(); ++i) {
    const int x = static_cast<int>(i) % (width + 4) - 2, y = static_cast<int>(i) / (width + 4) - 2;
    const float above = 0.75f * pixel(x, y) + 0.25f * pixel(x + 1, y),
                below = 0.75f * pixel(x, y + 1) + 0.25f * pixel(x + 1, y + 1);
    EXPECT_NEAR(four[i].r, (above + below) / 2, filter_error) << x << ", " << y;
    EXPECT_TRUE(one[i].r == pixel(x, y) || one[i].r == pixel(x, y + 1)) << x << ", " << y;
  }
}

TEST_F(Samplers, CompareDepths) {
  const gpu::ComputeProgram program(device(), lookup_shadow, "shadow");
  using Compare = Sampling::Compare;
  for (Format format : {Format::d32_float, Format::d16_unorm}) {
    const bool exact = format == Format::d32_float;
    const gpu::Image image(device(), width, height, format, ImageUse::attachment, "depths");
    if (exact) {
      write(commands_, image, pixels_);
    } else {
      std::vector<uint16_t> rounded;
      for (float depth : pixels_) rounded.push_back(static_cast<uint16_t>(std::lround(depth * 65535)));
      write(commands_, image, rounded);
    }
    std::vector<Query> queries;
    std::vector<float> nearest_depths;
    for (int y = -1; y <= height; ++y)
      for (int x = -1; x <= width; ++x)
        for (float off : {-0.01f, -0.0001f, 0.0f, 0.0001f, 0.01f}) {
          // Where depths are rounded, only what is not equal is certain.
          if (off == 0 && !exact) continue;
          const float depth = std::clamp(pixel(x, y) + off, 0.0f, 1.0f);
          if (!exact && depth == pixel(x, y)) continue;
          queries.push_back({at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), depth, 0});
          nearest_depths.push_back(pixel(x, y));
        }
    for (Compare compare : {Compare::greater_or_equal, Compare::less_or_equal})
      for (bool linear : {false, true}) {
        const Sampling sampling = Sampling::comparing(compare, linear);
        if (!supports(device(), format, ImageUse::attachment, sampling)) {
          std::cout << "the device does not mix comparisons of " << in_words(format) << "\n";
          continue;
        }
        const auto answers = look_up<glm::vec4>(commands_, program, {"picture", image, sampling}, queries);
        for (size_t i = 0; i < queries.size(); ++i) {
          const bool passes = compare == Compare::greater_or_equal ? queries[i].depth >= nearest_depths[i]
                                                                   : queries[i].depth <= nearest_depths[i];
          ASSERT_NEAR(answers[i].r, passes ? 1.0f : 0.0f, linear ? filter_error : 0)
              << in_words(format) << ": " << queries[i].depth << " and " << nearest_depths[i];
        }
      }
  }
}

TEST_F(Samplers, MixTheAnswersOfFourComparisons) {
  const Sampling sampling = Sampling::comparing(Sampling::Compare::greater_or_equal, true);
  if (!supports(device(), Format::d32_float, ImageUse::attachment, sampling))
    GTEST_SKIP() << "the device does not mix comparisons of 32-bit depths";
  const gpu::ComputeProgram program(device(), lookup_shadow, "shadow");
  // What the image is made with counts where the pass says nothing.
  const gpu::Image image(device(),
                         {.width = width,
                          .height = height,
                          .format = Format::d32_float,
                          .use = ImageUse::attachment,
                          .sampling = sampling},
                         "depths");
  write(commands_, image, pixels_);
  std::vector<Query> queries;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      queries.push_back({at(static_cast<float>(x) + 1, static_cast<float>(y) + 1), 0.5005f, 0});
  const auto answers = look_up<glm::vec4>(commands_, program, {"picture", image}, queries);
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width, y = i / width;
    float passed = 0;
    for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}})
      passed += 0.5005f >= pixel(x + dx, y + dy);
    ASSERT_NEAR(answers[static_cast<size_t>(i)].r, passed / 4, filter_error) << x << ", " << y;
  }
}

TEST_F(Samplers, ThatTheFormatDoesNotAllowAreNamed) {
  const gpu::ComputeProgram program(device(), lookup, "lookup");
  const gpu::Image image(device(), 4, 4, Format::r32_uint, ImageUse::storage, "words");
  const gpu::Buffer buffer(device(), 64, gpu::MemoryKind::device, "buffer");
  commands_.begin(gpu::Timing::none);
  try {
    commands_.dispatch(
        program, {{"picture", image, Sampling::linear()}, {"Queries", buffer}, {"Answers", buffer}}, 0u, 1);
    ADD_FAILURE() << "no error";
  } catch (const SystemError& error) {
    EXPECT_STREQ(error.what(), "lookup: 'picture' of format r32_uint lacks linear filtering");
  }
  commands_.submit();
}

}  // namespace
}  // namespace ml::test
