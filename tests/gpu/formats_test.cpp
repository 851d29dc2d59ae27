// What is stored to an image of each format is what its bytes say and what shaders read.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/packing.hpp>

#include "harness/base/error.h"
#include "spirv/lookup_fetch.h"
#include "spirv/lookup_fetch_uint.h"
#include "spirv/store_r16f.h"
#include "spirv/store_r32f.h"
#include "spirv/store_r8.h"
#include "spirv/store_rg16f.h"
#include "spirv/store_rg32f.h"
#include "spirv/store_rg8.h"
#include "spirv/store_rgba16f.h"
#include "spirv/store_rgba32ui.h"
#include "tests/gpu/pictures.h"

namespace ml::test {
namespace {

using gpu::Format;
using gpu::ImageUse;

constexpr uint32_t width = 7, height = 5;

class Formats : public DeviceTest {
 protected:
  gpu::Commands commands_{device()};
};

// A component's bytes.
void append_half(float value, std::vector<std::byte>& bytes) {
  const uint16_t half = glm::packHalf1x16(value);
  const auto* first = reinterpret_cast<const std::byte*>(&half);
  bytes.insert(bytes.end(), first, first + sizeof(half));
}
void append_float(float value, std::vector<std::byte>& bytes) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof(value));
}
void append_unorm(float value, std::vector<std::byte>& bytes) {
  bytes.push_back(static_cast<std::byte>(std::lround(value * 255)));
}

struct Stored {
  Format format;
  std::span<const uint32_t> program;
  int components;
  void (*append)(float, std::vector<std::byte>&);
  // Of the i-th number: one that the format has.
  std::function<float(int)> value;
};

std::vector<Stored> stored_formats() {
  // All halves are sums of few powers of two; among these are subnormal and negative ones, and the largest.
  const auto half = [](int i) {
    return i % 11 == 0 ? 65504.0f : std::ldexp(static_cast<float>(i % 1024) - 300, i % 17 - 14);
  };
  const auto full = [](int i) { return std::ldexp(static_cast<float>(i * 7919) - 1e6f, i % 61 - 30); };
  const auto unorm = [](int i) { return static_cast<float>(i * 5 % 256) / 255; };
  return {{Format::r16_float, store_r16f, 1, append_half, half},
          {Format::rg16_float, store_rg16f, 2, append_half, half},
          {Format::rgba16_float, store_rgba16f, 4, append_half, half},
          {Format::r32_float, store_r32f, 1, append_float, full},
          {Format::rg32_float, store_rg32f, 2, append_float, full},
          {Format::r8_unorm, store_r8, 1, append_unorm, unorm},
          {Format::rg8_unorm, store_rg8, 2, append_unorm, unorm}};
}

std::vector<Query> every_texel() {
  std::vector<Query> queries;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) queries.push_back({{x, y}, 0, 0});
  return queries;
}

TEST_F(Formats, StoredNumbersAreReadBack) {
  const gpu::ComputeProgram fetch(device(), lookup_fetch, "fetch");
  for (const Stored& stored : stored_formats()) {
    SCOPED_TRACE(in_words(stored.format));
    if (!supports(device(), stored.format, ImageUse::storage)) {
      std::cout << "the device stores no " << in_words(stored.format) << "\n";
      continue;
    }
    const gpu::ComputeProgram store(device(), stored.program, "store");
    const gpu::Image image(device(), width, height, stored.format, ImageUse::storage, "stored");
    std::vector<glm::vec4> values(width * height);
    std::vector<std::byte> expected;
    for (int i = 0; i < static_cast<int>(values.size()); ++i)
      for (int c = 0; c < 4; ++c) {
        const float value = stored.value(4 * i + c);
        // Components that the format lacks are read as 0, alpha as 1.
        values[i][c] = value;
        if (c < stored.components) stored.append(value, expected);
      }
    ASSERT_EQ(expected.size(), image.bytes());
    const gpu::Buffer numbers = uploaded(std::span<const glm::vec4>(values), "values");
    commands_.begin(gpu::Timing::none);
    commands_.dispatch(store, {{"picture", image}, {"Values", numbers}}, std::span<const std::byte>(), 1);
    commands_.submit();
    EXPECT_EQ(read<std::byte>(commands_, image), expected);
    const auto seen = look_up<glm::vec4>(commands_, fetch, {"picture", image}, every_texel());
    for (size_t i = 0; i < values.size(); ++i)
      for (int c = 0; c < 4; ++c) {
        const float value = c < stored.components ? values[i][c] : c == 3 ? 1 : 0;
        ASSERT_NEAR(seen[i][c], value, stored.append == append_unorm ? 1e-6f : 0) << i << ", " << c;
      }
  }
}

TEST_F(Formats, FourWordsAreReadBack) {
  const gpu::ComputeProgram store(device(), store_rgba32ui, "store"),
      fetch(device(), lookup_fetch_uint, "fetch");
  const gpu::Image image(device(), width, height, Format::rgba32_uint, ImageUse::storage, "stored");
  std::vector<glm::uvec4> values(width * height);
  for (uint32_t i = 0; i < values.size(); ++i)
    values[i] = glm::uvec4(i, ~i, 0x7fc00000u + i, 0x80000001u * (i + 1));
  const gpu::Buffer words = uploaded(std::span<const glm::uvec4>(values), "values");
  commands_.begin(gpu::Timing::none);
  commands_.dispatch(store, {{"picture", image}, {"Values", words}}, std::span<const std::byte>(), 1);
  commands_.submit();
  EXPECT_EQ(read<glm::uvec4>(commands_, image), values);
  EXPECT_EQ(look_up<glm::uvec4>(commands_, fetch, {"picture", image}, every_texel()), values);
}

TEST_F(Formats, DepthsOfBothSizesAreWrittenAndCleared) {
  const gpu::Buffer vertices(device(), 64, gpu::MemoryKind::device, "vertices");
  auto check = [&](Format format, auto one) {
    const gpu::Image image(device(), width, height, format, ImageUse::attachment, "depth");
    const std::vector<decltype(one)> full(width * height, one), empty(width * height, 0);
    write(commands_, image, full);
    EXPECT_EQ(read<decltype(one)>(commands_, image), full) << in_words(format);
    commands_.begin(gpu::Timing::none);
    commands_.raster({{}, &image}, vertices, vertices, {});
    commands_.submit();
    EXPECT_EQ(read<decltype(one)>(commands_, image), empty) << in_words(format);
    write(commands_, image, full);
    commands_.begin(gpu::Timing::none);
    commands_.clear(image);
    commands_.submit();
    EXPECT_EQ(read<decltype(one)>(commands_, image), empty) << in_words(format);
  };
  check(Format::d16_unorm, uint16_t{0xffff});
  check(Format::d32_float, 1.0f);
}

TEST_F(Formats, WhatTheDeviceLacksIsNamed) {
  auto error_of = [](Format format, ImageUse use, const gpu::Sampling& sampling) -> std::string {
    try {
      gpu::Image(device(), {.width = 4, .height = 4, .format = format, .use = use, .sampling = sampling},
                 "my image");
    } catch (const SystemError& error) {
      return error.what();
    }
    return "";
  };
  using Sampling = gpu::Sampling;
  // No device stores depths, and none filters integers or compares colours.
  EXPECT_FALSE(supports(device(), Format::d32_float, ImageUse::storage));
  const std::string stored = error_of(Format::d32_float, ImageUse::storage, Sampling::nearest());
  for (const char* part : {"my image", "d32_float", "storage"})
    EXPECT_NE(stored.find(part), stored.npos) << stored;
  const std::string filtered = error_of(Format::rgba32_uint, ImageUse::texture, Sampling::linear());
  EXPECT_NE(filtered.find("rgba32_uint"), filtered.npos) << filtered;
  EXPECT_NE(filtered.find("linear filtering"), filtered.npos) << filtered;
  const auto comparing = Sampling::comparing(Sampling::Compare::greater_or_equal, false);
  const std::string compared = error_of(Format::r32_uint, ImageUse::texture, comparing);
  EXPECT_NE(compared.find("comparisons"), compared.npos) << compared;
  EXPECT_TRUE(supports(device(), Format::rgba16_float, ImageUse::storage_attachment, Sampling::linear()));
  EXPECT_TRUE(supports(device(), Format::d16_unorm, ImageUse::attachment, comparing));
}

}  // namespace
}  // namespace ml::test
