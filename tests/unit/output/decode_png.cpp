#include "decode_png.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "harness/base/file.h"

DecodedPng decode_png(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  uint8_t* pixels = stbi_load(file.c_str(), &width, &height, &channels, 3);
  DecodedPng picture;
  if (!pixels) {
    ADD_FAILURE() << file << " is no PNG: " << stbi_failure_reason();
    return picture;
  }
  EXPECT_EQ(channels, 3);
  picture.width = static_cast<uint32_t>(width), picture.height = static_cast<uint32_t>(height);
  picture.rgb.assign(pixels, pixels + size_t{3} * picture.width * picture.height);
  stbi_image_free(pixels);
  return picture;
}

std::string png_description(const std::filesystem::path& file) {
  auto bytes = ml::read_file(file);
  auto u32 = [&](size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    return value;
  };
  for (size_t at = 8; at + 12 <= bytes.size(); at += 12 + u32(at)) {
    std::string content(reinterpret_cast<const char*>(&bytes[at + 4]), 4 + u32(at));
    if (content.rfind("tEXtDescription", 0) == 0) return content.substr(16);
  }
  return "";
}
