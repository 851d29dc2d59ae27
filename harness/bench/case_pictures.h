// Pictures of one case and frame: the HDR image and the heat maps of its work.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/bench/counting.h"
#include "harness/output/picture.h"

namespace ml {

// Picture of the shading result (R, G, B).
Picture result_picture(DeviceFrame& frame);
// One-channel picture of a count; pixels without a surface are -1.
Picture count_picture(const std::vector<uint32_t>& counts, const std::vector<uint8_t>& lit, uint32_t width,
                      uint32_t height);

// Writes FOLDER/STEM.exr and .png; returns the names relative to the folder.
std::vector<std::string> write_image(DeviceFrame& frame, const std::filesystem::path& folder,
                                     const std::string& stem);
// Writes `listed` and `contributing`, `nodes` and `traversal` where there are any, and the algorithm's own
// counters, per pixel and per tile (the tile's largest value) as EXR and PNG; returns the names relative to
// the folder.
struct HeatMaps {
  const PixelCounts& counts;
  const std::vector<CounterInfo>& own;                         // declared by the algorithm
  const std::map<std::string, std::vector<uint32_t>>& values;  // of those that are per pixel
  const std::vector<uint8_t>& lit;
  uint32_t width, height, tile;  // px
};
std::vector<std::string> write_heat_maps(const HeatMaps& maps, const std::filesystem::path& folder,
                                         const std::string& stem);

}  // namespace ml
