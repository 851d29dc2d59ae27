#include "algorithms/froxels/froxel_parameters.h"

namespace ml {

std::vector<ParameterInfo> froxel_parameters() {
  return {
      ParameterInfo::integer("tile", 24, 4, 1024, "side of a screen tile in pixels"),
      ParameterInfo::integer("slices", 16, 1, 256, "depth slices: one near slice and the rest exponential"),
      ParameterInfo::real("zmin", 5, 0.01, 1e6, "depth in metres at which the near slice ends"),
      ParameterInfo::real("zmax", 0, 0, 1e9,
                          "depth in metres at which the last slice ends; 0: the scene's far depth"),
      ParameterInfo::boolean("refinement", false, "narrow each row and slice of froxels to the light's ball"),
      ball_test_parameter(),
      index_bits_parameter(),
  };
}

ParameterInfo ball_test_parameter() {
  return ParameterInfo::boolean(
      "ball_test", true, "leave out cells that the light's ball misses inside its box, by an exact test");
}

ParameterInfo index_bits_parameter() {
  return ParameterInfo::choice("index_bits", "32", {"32", "16"},
                               "bits of a list's light indices; 16 only in frames of at most 65,536 lights");
}

void read_list_settings(const Parameters& parameters, FroxelSettings& settings) {
  settings.ball_test = parameters.boolean("ball_test");
  settings.narrow = parameters.choice("index_bits") == "16";
}

FroxelSettings froxel_settings(const Parameters& p) {
  FroxelSettings settings;
  settings.tile = static_cast<uint32_t>(p.integer("tile"));
  settings.slices = static_cast<uint32_t>(p.integer("slices"));
  settings.zmin = static_cast<float>(p.real("zmin"));
  settings.zmax = static_cast<float>(p.real("zmax"));
  settings.refinement = p.boolean("refinement");
  read_list_settings(p, settings);
  return settings;
}

std::string froxel_check(const Parameters& p, uint32_t width, uint32_t height) {
  if (p.real("zmax") > 0 && p.real("zmax") <= p.real("zmin")) return "zmax must be greater than zmin";
  auto tiles = [&](uint32_t pixels) { return (pixels + p.integer("tile") - 1) / p.integer("tile"); };
  // Offsets of one buffer of the smallest range that Vulkan 1.3 devices have (2^27 bytes).
  int64_t froxels = tiles(width) * tiles(height) * p.integer("slices");
  if (froxels >= int64_t{1} << 25)
    return "tile and slices give " + std::to_string(froxels) + " froxels; at most 33554431 are possible";
  return "";
}

ParameterInfo walk_parameter() {
  return ParameterInfo::choice("walk", "subgroup", {"subgroup", "pixel"},
                               "the pixels of a subgroup walk a cell's lights together, fetching each light "
                               "once, or each pixel alone");
}

bool walk_together(const Parameters& parameters) {
  return parameters.choice("walk") != "pixel";
}

}  // namespace ml
