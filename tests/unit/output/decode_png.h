// PNG files read back by a decoder that is not ours (stb_image).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/output/color_scale.h"

struct DecodedPng {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgb;
  ml::Color at(uint32_t x, uint32_t y) const {
    const uint8_t* pixel = &rgb[3 * (static_cast<size_t>(y) * width + x)];
    return {pixel[0], pixel[1], pixel[2]};
  }
};

DecodedPng decode_png(const std::filesystem::path& file);
// The tEXt chunk "Description", or "".
std::string png_description(const std::filesystem::path& file);
