// What light trees and the hybrid have in common beside their shaders: prepare() of trees behind the
// interface, and the entry of the registry.
#pragma once

#include "algorithms/trees/tree_prepare.h"

namespace ml {

class TreeAlgorithm : public Algorithm {
 public:
  TreeAlgorithm(const std::string& name, const FroxelSettings& froxels, const ForestSettings& trees,
                bool together)
      : trees_(name, froxels, trees), together_(together) {}

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) final {
    trees_.prepare(frame, memory, spans);
  }
  PrepareCounters counters() const final { return trees_.counters(); }
  std::vector<std::string> buffers() const final { return TreePrepare::buffers(); }
  bool walks_together() const final { return together_; }

 private:
  TreePrepare trees_;
  bool together_;
};

// Name, paper and stages; the parameters of trees behind those of the grid.
AlgorithmEntry tree_entry(const std::string& name, const std::string& summary,
                          std::vector<ParameterInfo> grid);

}  // namespace ml
