// The lights of one frame as CSV, for programs that check a frame on their own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ml {

// A light as the GPU has it: single precision, camera-relative (world axes).
struct LightRow {
  float position[3] = {0, 0, 0};         // m
  float radius = 1;                      // m, of the window; boxes: half the diagonal
  float intensity[3] = {1, 1, 1};        // W/sr
  std::string shape = "omni";            // or "spot", "capsule", "wedge", "box"
  float direction[3] = {0, 0, 0};        // unit, away from the light: spot, wedge, box; else 0
  float cone_scale = 1, cone_limit = 4;  // cone factor = clamp((limit - (1 - cos)) * scale, 0, 1)^2
  float cos_outer = -2;                  // 1 - cone_limit, rounded
  float side[3] = {0, 0, 0};             // unit: capsule, wedge, box; else 0
  float half_length = 0;                 // m: the source is the segment position +- half_length * side
  float half_extents[3] = {0, 0, 0};     // m: box, along side, cross(direction, side), direction; else 0
  bool probe = false;                    // 1 or 0: ambient light in the volume, intensity in W/m^2
};

// Line 1 names columns and units; then one line a light, `index` counting from 0. Floats have 9 significant
// digits, enough to give back the same bits. Throws SystemError.
void write_lights_csv(const std::vector<LightRow>& lights, const std::filesystem::path& file);

// Throws UsageError naming file and line.
std::vector<LightRow> read_lights_csv(const std::filesystem::path& file);

}  // namespace ml
