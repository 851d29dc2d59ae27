// What light trees and the hybrid have in common beside their shaders: prepare() and the entry of the
// registry.
#pragma once

#include "algorithms/trees/tree_prepare.h"

namespace ml {

class TreeAlgorithm : public Algorithm {
 public:
  TreeAlgorithm(const std::string& name, const FroxelSettings& froxels, const TreeSettings& trees,
                const Parameters& parameters);

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) final {
    trees_.prepare(frame, memory, spans);
  }
  PrepareCounters counters() const final { return trees_.counters(); }
  std::vector<std::string> buffers() const final { return TreePrepare::buffers(); }
  bool walks_together() const final { return together_; }
  LongestWalk longest_walk(const FrameInput&) const final { return trees_.longest_walk(masked_); }
  // Class 1 has trees, class 0 nothing but lists.
  TileClasses tile_classes() const final { return trees_.tile_classes(); }
  gpu::Constants class_constants(uint32_t tile_class) const final { return {{"HAS_TREES", tile_class}}; }
  // A tree holds the lights of its cell's list.
  std::optional<uint32_t> lights_listed(glm::uvec2 pixel, float depth) const final {
    return trees_.lists().lights_at(pixel, depth);
  }

 protected:
  // Those of tree_walk.glsl.
  gpu::Constants tree_constants() const { return {{"NARROW_INDICES", narrow_}, {"MASKED", masked_}}; }

 private:
  TreePrepare trees_;
  bool together_, masked_, narrow_;
};

// How pixels walk a tree: `walk`, with the masked walk beside those of lists.
ParameterInfo tree_walk_parameter();

// Name, paper and stages; the parameters of trees after those of the grid.
AlgorithmEntry tree_entry(const std::string& name, const std::string& summary,
                          std::vector<ParameterInfo> grid);

}  // namespace ml
