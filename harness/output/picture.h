// Pictures in memory and on disk: EXR (32-bit float, ZIP) and PNG previews, heat maps with legend.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ml {

// Row by row from the top, channels interleaved.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<std::string> channels;  // EXR names in the order of the data: {"R","G","B"} or {"Y"} or {"X","Y","Z"}
  std::vector<float> data;            // width * height * channels.size()

  Picture() = default;
  Picture(uint32_t w, uint32_t h, std::vector<std::string> names);
  size_t pixel(uint32_t x, uint32_t y) const { return (static_cast<size_t>(y) * width + x) * channels.size(); }
};

// FLOAT, ZIP, whole or not at all. `attributes` are stored as EXR string attributes. Throws SystemError.
void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& attributes = {});
// Throws UsageError on a file that is missing or not an EXR.
Picture read_exr(const std::filesystem::path& file);

// How HDR became 8 bits, to be stated beside the picture: exposure from the picture's own luminance (its 99th percentile over pixels
// that are lit at all becomes `white`), then x / (1 + x) scaled so that white maps to 1 ("extended Reinhard"), then the sRGB curve.
struct ToneCurve {
  float exposure = 0;  // factor; 0: chosen from the picture
  float white = 4;
  std::string describe(float used_exposure) const;
};
// Writes a PNG preview with the tone curve in its tEXt chunk "Description"; returns the exposure used. NaN pixels are magenta, infinite
// ones white. Throws SystemError.
float write_preview_png(const Picture& rgb, const std::filesystem::path& file, const ToneCurve& curve = {});

// 8-bit RGB, row by row. Throws SystemError.
void write_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb, const std::filesystem::path& file,
               const std::string& description = "");

// A heat map of a one-channel picture: colour-blind-safe scale (viridis-like, computed here), legend bar below with numbers and title, the
// maximum marked by a ring and its value and pixel in the legend. `maximum` 0: the picture's own. Pixels that are negative have no value
// (sky) and are drawn dark grey. `block` > 1 draws tile maps with one value a tile blown up to block x block pixels.
struct HeatMapStyle {
  std::string title;  // "lights listed per pixel"
  double maximum = 0;
  uint32_t block = 1;
  // When not empty, values are classes: colours from a qualitative colour-blind-safe set, legend with these names.
  std::vector<std::string> classes;
};
void write_heat_map_png(const Picture& values, const std::filesystem::path& file, const HeatMapStyle& style);

}  // namespace ml
