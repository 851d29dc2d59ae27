#include "algorithms/light_tree/light_tree.h"

#include <limits>

#include "algorithms/froxels/froxel_parameters.h"
#include "algorithms/trees/tree_prepare.h"
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
  return settings;
}

ForestSettings always_trees(const Parameters& p) {
  ForestSettings settings = tree_settings(p);
  settings.threshold = std::numeric_limits<float>::infinity();
  return settings;
}

class LightTree final : public Algorithm {
 public:
  explicit LightTree(const Parameters& p)
      : trees_("light_tree", tiles(p), always_trees(p)), together_(walk_together(p)) {}

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    trees_.prepare(frame, memory, spans);
  }
  PrepareCounters counters() const override { return trees_.counters(); }
  std::vector<std::string> buffers() const override { return TreePrepare::buffers(); }
  bool walks_together() const override { return together_; }
  ShadeShaders shade_shaders() const override {
    return {light_tree_shade, light_tree_shade_counting, light_tree_forward, light_tree_forward_counting};
  }

 private:
  TreePrepare trees_;
  bool together_;
};

}  // namespace

AlgorithmEntry light_tree_entry() {
  AlgorithmEntry entry;
  entry.info.name = "light_tree";
  entry.info.summary = "one tree over depth for each tile, built on the CPU";
  entry.info.paper = "O'Donnell & Chajdas, Tiled Light Trees, I3D 2017";
  entry.info.cpu_stages = {"cull", "sort", "bin", "build", "upload"};
  entry.info.gpu_stages = {"shade"};
  entry.info.shapes = {"omni", "spot", "capsule", "wedge", "box"};
  entry.parameters = {ParameterInfo::integer("tile", 24, 4, 1024, "side of a screen tile in pixels")};
  for (ParameterInfo& info : tree_parameters()) entry.parameters.push_back(std::move(info));
  entry.parameters.push_back(walk_parameter());
  entry.create = [](const Parameters& parameters) { return std::make_unique<LightTree>(parameters); };
  return entry;
}

}  // namespace ml
