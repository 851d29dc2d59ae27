// Clustered binning as the papers describe it (Persson 2013; Tiled Light Trees 2017, section 4.1), in plain
// scalar code: the oracle of the fast path's tests and the baseline of its benchmark.
#pragma once

#include "algorithms/clustered/cluster_lists.h"

namespace ml {

class ReferenceLists {
 public:
  // For each light in view its box of froxels; a first walk over the boxes counts, a second scatters. No
  // refinement.
  void build(const FrameInput& frame, const ClusterSettings& settings);

  const FroxelGrid& grid() const { return grid_; }
  const std::vector<uint32_t>& offsets() const { return offsets_; }  // one more than froxels
  const std::vector<uint32_t>& indices() const { return indices_; }

 private:
  FroxelGrid grid_;
  VisibleLights visible_;
  std::vector<FroxelBox> boxes_;
  std::vector<uint32_t> offsets_, next_, indices_;
};

}  // namespace ml
