// `render`: one frame of a configuration as pictures, with everything that is needed to check its numbers
// elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/config/config.h"

namespace ml {

struct RenderOptions {
  uint32_t frame = 0;
  std::filesystem::path out;      // .exr or .png
  std::string algorithm;          // name; empty: the configuration's first
  std::vector<std::string> aovs;  // of aov_names(); "all" is every one
  std::filesystem::path lights;   // CSV of the frame's lights; empty: none
  std::string device;
  bool validation = false;
};

// position, normal, depth, albedo, material, contributing, listed.
const std::vector<std::string>& aov_names();

// Renders the frame of the configuration's first setup. AOVs are written beside `out` as STEM.NAME.exr.
// Returns all files written. Tells on stderr what the level brings and what of it is used. Throws UsageError
// (frame or AOV out of range, unknown ending, a frame in which no surface is seen) and SystemError.
std::vector<std::filesystem::path> render_frame(const Config& config, const RenderOptions& options);

}  // namespace ml
