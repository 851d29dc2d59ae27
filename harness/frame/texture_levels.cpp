#include "harness/frame/texture_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ml {
namespace {

// Light of an sRGB byte (IEC 61966-2-1), in [0, 1].
const std::array<float, 256>& light_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (size_t i = 0; i < 256; ++i) {
      const double code = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

uint8_t byte_of(float value, bool srgb) {
  if (!srgb) return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
  // The byte whose light is nearest.
  const auto& table = light_of_byte();
  const auto above = std::lower_bound(table.begin(), table.end(), value);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const bool lower = value - *(above - 1) < *above - value;
  return static_cast<uint8_t>(above - table.begin() - (lower ? 1 : 0));
}

// What one pixel of the smaller picture covers along one axis: pixels and their weights, which add up to 1.
struct Cover {
  uint32_t first = 0, count = 0;
  std::array<float, 3> weight{};
};

Cover cover_of(uint32_t pixel, uint32_t from, uint32_t to) {
  // Three at most, because a picture is halved: 2 n + 1 pixels become n.
  const double scale = static_cast<double>(from) / to, begin = pixel * scale, end = (pixel + 1) * scale;
  Cover cover;
  cover.first = static_cast<uint32_t>(begin);
  for (uint32_t i = cover.first; i < from && i < end && cover.count < 3; ++i)
    cover.weight[cover.count++] =
        static_cast<float>((std::min<double>(i + 1, end) - std::max<double>(i, begin)) / scale);
  return cover;
}

}  // namespace

uint32_t level_count(uint32_t width, uint32_t height) {
  return static_cast<uint32_t>(std::bit_width(std::max({width, height, 1u})));
}

std::vector<uint8_t> with_levels(const Texture& texture, bool srgb) {
  std::vector<uint8_t> all = texture.rgba;
  uint32_t width = texture.width, height = texture.height;
  size_t source = 0;
  while (width > 1 || height > 1) {
    const uint32_t across = std::max(width / 2, 1u), down = std::max(height / 2, 1u);
    const size_t target = all.size();
    all.resize(target + size_t{across} * down * 4);
    for (uint32_t y = 0; y < down; ++y) {
      const Cover rows = cover_of(y, height, down);
      for (uint32_t x = 0; x < across; ++x) {
        const Cover columns = cover_of(x, width, across);
        std::array<float, 4> sum{};
        for (uint32_t j = 0; j < rows.count; ++j)
          for (uint32_t i = 0; i < columns.count; ++i) {
            const uint8_t* pixel = &all[source + (size_t{rows.first + j} * width + columns.first + i) * 4];
            const float weight = rows.weight[j] * columns.weight[i];
            for (size_t c = 0; c < 4; ++c)
              sum[c] += weight *
                        (srgb && c < 3 ? light_of_byte()[pixel[c]] : static_cast<float>(pixel[c]) / 255.0f);
          }
        for (size_t c = 0; c < 4; ++c)
          all[target + (size_t{y} * across + x) * 4 + c] = byte_of(sum[c], srgb && c < 3);
      }
    }
    source = target;
    width = across;
    height = down;
  }
  return all;
}

}  // namespace ml
