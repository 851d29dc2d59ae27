// Pictures in memory and on disk: EXR (32-bit float, ZIP) and PNG previews, heat maps with legend.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ml {

// Row by row from the top, channels interleaved.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<std::string>
      channels;             // EXR names in the order of the data: {"R","G","B"} or {"Y"} or {"X","Y","Z"}
  std::vector<float> data;  // width * height * channels.size()

  Picture() = default;
  Picture(uint32_t w, uint32_t h, std::vector<std::string> names);
  size_t pixel(uint32_t x, uint32_t y) const {
    return (static_cast<size_t>(y) * width + x) * channels.size();
  }
};

// FLOAT, ZIP, whole or not at all; the same picture gives the same bytes. `attributes` are stored as EXR
// string attributes. Throws SystemError.
void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& attributes = {});
// Reads the data window as 32-bit float, whatever the file's own type. Channels come in the order R, G, B, A
// where there are any of these, then by name: an EXR keeps no other order. Throws UsageError on a file that
// is missing, not an EXR, damaged, or larger than 32768 pixels a side or 16 channels.
Picture read_exr(const std::filesystem::path& file);

// How HDR became 8 bits, to be stated beside the picture: exposure from the picture's own luminance (its 99th
// percentile over pixels that are lit at all becomes `white`), then x (1 + x / white^2) / (1 + x), which maps
// white to 1 ("extended Reinhard", per channel), then the sRGB curve.
struct ToneCurve {
  float exposure = 0;  // factor; 0: chosen from the picture
  float white = 4;
  std::string describe(float used_exposure) const;
};
// Writes a PNG preview of a picture of one (grey) or three and more channels (the first three are red, green,
// blue), with the tone curve in its tEXt chunk "Description"; returns the exposure used. NaN pixels are
// magenta, infinite ones white. Throws SystemError.
float write_preview_png(const Picture& rgb, const std::filesystem::path& file, const ToneCurve& curve = {});

// 8-bit RGB, row by row. Throws SystemError.
void write_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb,
               const std::filesystem::path& file, const std::string& description = "");

// A heat map of a one-channel picture: the map itself in the upper left corner, pixel for pixel, below it a
// legend with a scale that colour-blind readers can tell apart (color_scale.h), its numbers, the title, and
// the maximum with its pixel, which a ring marks in the map. Exactly 0 is black and no part of the scale.
// Pixels that are negative have no value (sky) and are drawn dark grey; NaN and infinities are magenta and
// counted in the legend.
struct HeatMapStyle {
  std::string title{};  // "lights listed per pixel"
  double maximum = 0;   // end of the scale; larger values get its last colour; 0: the picture's own maximum
  uint32_t block = 1;   // > 1: a tile map with one value a tile, blown up to block x block pixels
  // When not empty (at most 8), values are classes 0, 1, ...: qualitative colours, legend with these names
  // and their shares.
  std::vector<std::string> classes{};
  std::string unit{};  // put after the title: "[ms]"
};
// Throws SystemError; std::invalid_argument for a picture of several channels, more than 8 classes, or a map
// above 2^16 pixels a side.
void write_heat_map_png(const Picture& values, const std::filesystem::path& file, const HeatMapStyle& style);

}  // namespace ml
