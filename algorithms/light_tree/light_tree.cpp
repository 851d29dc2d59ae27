#include "algorithms/light_tree/light_tree.h"

#include <limits>

#include "algorithms/froxels/froxel_parameters.h"
#include "algorithms/trees/tree_algorithm.h"
#include "spirv/light_tree_forward.h"
#include "spirv/light_tree_forward_counting.h"
#include "spirv/light_tree_shade.h"
#include "spirv/light_tree_shade_counting.h"

namespace ml {
namespace {

FroxelSettings tiles(const Parameters& p) {
  FroxelSettings settings;
  settings.tile = static_cast<uint32_t>(p.integer("tile"));
  settings.slices = 1;
  read_list_settings(p, settings);
  settings.chords = with_chords(p);
  return settings;
}

TreeSettings always_trees(const Parameters& p) {
  TreeSettings settings = tree_settings(p);
  settings.threshold = std::numeric_limits<float>::infinity();
  return settings;
}

class LightTree final : public TreeAlgorithm {
 public:
  explicit LightTree(const Parameters& p) : TreeAlgorithm("light_tree", tiles(p), always_trees(p), p) {}
  ShadeShaders shade_shaders() const override {
    return {light_tree_shade, light_tree_shade_counting, light_tree_forward, light_tree_forward_counting};
  }
  gpu::Constants shade_constants() const override { return tree_constants(); }
};

}  // namespace

AlgorithmEntry light_tree_entry() {
  AlgorithmEntry entry =
      tree_entry("light_tree", "one tree over depth for each tile, built on the CPU",
                 {ParameterInfo::integer("tile", 24, 4, 1024, "side of a screen tile in pixels"),
                  ball_test_parameter(), index_bits_parameter()});
  entry.parameters.push_back(tree_walk_parameter());
  entry.create = [](const Parameters& parameters) { return std::make_unique<LightTree>(parameters); };
  return entry;
}

}  // namespace ml
