#include "harness/bench/case_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/file.h"

namespace ml {
namespace {

// The largest value of each tile; tiles without a surface are -1.
Picture tile_maximum(const Picture& pixels, uint32_t tile) {
  Picture tiles((pixels.width + tile - 1) / tile, (pixels.height + tile - 1) / tile, {"Y"});
  std::fill(tiles.data.begin(), tiles.data.end(), -1.0f);
  for (uint32_t y = 0; y < pixels.height; ++y)
    for (uint32_t x = 0; x < pixels.width; ++x) {
      float& value = tiles.data[tiles.pixel(x / tile, y / tile)];
      value = std::max(value, pixels.data[pixels.pixel(x, y)]);
    }
  return tiles;
}

// Which classes a tile's pixels have: the one that all have, or `mixed`; tiles without a surface are -1.
Picture tile_class(const Picture& pixels, uint32_t tile, float mixed) {
  Picture tiles((pixels.width + tile - 1) / tile, (pixels.height + tile - 1) / tile, {"Y"});
  std::fill(tiles.data.begin(), tiles.data.end(), -1.0f);
  for (uint32_t y = 0; y < pixels.height; ++y)
    for (uint32_t x = 0; x < pixels.width; ++x) {
      const float value = pixels.data[pixels.pixel(x, y)];
      float& kept = tiles.data[tiles.pixel(x / tile, y / tile)];
      if (value >= 0) kept = kept < 0 || kept == value ? value : mixed;
    }
  return tiles;
}

bool any(const std::vector<uint32_t>& values) {
  return std::any_of(values.begin(), values.end(), [](uint32_t value) { return value != 0; });
}

void write_pair(const Picture& picture, const std::filesystem::path& folder, const std::string& stem,
                const HeatMapStyle& style, std::vector<std::string>& files) {
  make_output_directory((folder / stem).parent_path());
  write_exr(picture, folder / (stem + ".exr"), {{"title", style.title}});
  write_heat_map_png(picture, folder / (stem + ".png"), style);
  files.push_back(stem + ".exr");
  files.push_back(stem + ".png");
}

}  // namespace

Picture result_picture(DeviceFrame& frame) {
  std::vector<float> rgba = frame.read_floats(frame.targets().result);
  Picture picture(frame.targets().width(), frame.targets().height(), {"R", "G", "B"});
  for (size_t i = 0; i < rgba.size() / 4; ++i)
    for (size_t channel = 0; channel < 3; ++channel) picture.data[3 * i + channel] = rgba[4 * i + channel];
  return picture;
}

Picture count_picture(const std::vector<uint32_t>& counts, const std::vector<uint8_t>& lit, uint32_t width,
                      uint32_t height) {
  Picture picture(width, height, {"Y"});
  for (size_t i = 0; i < counts.size(); ++i) picture.data[i] = lit[i] ? static_cast<float>(counts[i]) : -1.0f;
  return picture;
}

std::vector<std::string> write_image(DeviceFrame& frame, const std::filesystem::path& folder,
                                     const std::string& stem) {
  Picture picture = result_picture(frame);
  make_output_directory((folder / stem).parent_path());
  write_exr(picture, folder / (stem + ".exr"));
  write_preview_png(picture, folder / (stem + ".png"));
  return {stem + ".exr", stem + ".png"};
}

std::vector<std::string> write_heat_maps(const HeatMaps& maps, const std::filesystem::path& folder,
                                         const std::string& stem) {
  struct Quantity {
    std::string name, title;
    const std::vector<uint32_t>& values;
    std::vector<std::string> classes;
    bool wanted;
  };
  const PixelCounts& counts = maps.counts;
  const uint32_t tile = maps.tile;
  std::vector<Quantity> quantities{
      {"listed", "lights listed per pixel", counts.listed, {}, true},
      {"contributing", "lights contributing per pixel", counts.contributing, {}, true},
      {"nodes", "tree nodes visited per pixel", counts.nodes, {}, any(counts.nodes)},
      {"traversal", "traversal", counts.traversal, {"list", "tree", "mixed"}, any(counts.traversal)},
  };
  for (const CounterInfo& counter : maps.own)
    if (const auto found = maps.values.find(counter.name); found != maps.values.end())
      quantities.push_back({counter.name, counter.help, found->second, {}, true});
  std::vector<std::string> files;
  for (const Quantity& quantity : quantities) {
    if (!quantity.wanted) continue;
    Picture pixels = count_picture(quantity.values, maps.lit, maps.width, maps.height);
    HeatMapStyle style;
    style.title = quantity.title;
    style.classes = quantity.classes;
    write_pair(pixels, folder, fmt::format("{}.{}", stem, quantity.name), style, files);
    style.title = fmt::format("{}, {} of each {} px tile", quantity.title,
                              quantity.classes.empty() ? "largest" : "class", tile);
    style.block = tile;
    write_pair(quantity.classes.empty()
                   ? tile_maximum(pixels, tile)
                   : tile_class(pixels, tile, static_cast<float>(quantity.classes.size() - 1)),
               folder, fmt::format("{}.{}.tiles", stem, quantity.name), style, files);
  }
  return files;
}

}  // namespace ml
