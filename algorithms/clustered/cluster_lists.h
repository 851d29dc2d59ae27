// The lists of practical clustered shading, from a frame's lights to one array of indices: cull, bound,
// count, scatter.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/clustered/binning.h"
#include "algorithms/clustered/refinement.h"

namespace ml {

struct ClusterSettings {
  uint32_t tile = 24;  // px
  uint32_t slices = 16;
  float zmin = 5;  // m, end of the near slice
  float zmax = 0;  // m, 0: the view's far
  bool refinement = false;
};

class ClusterLists {
 public:
  // Builds the lists of a frame; spans `cull` and `bin`. The lists of a froxel are in ascending order of
  // light index and do not depend on the number of threads. Throws SystemError when they would hold more than
  // `max_entries`.
  void build(const FrameInput& frame, const ClusterSettings& settings, uint64_t max_entries, Spans& spans);

  const FroxelGrid& grid() const { return grid_; }
  // Where each froxel's list begins in indices(), and one more: the end of the last.
  std::span<const uint32_t> offsets() const { return std::span(offsets_).first(grid_.cells() + size_t{1}); }
  std::span<const uint32_t> indices() const { return std::span(indices_).first(entries_); }
  uint64_t lights_in_frustum() const { return in_frustum_; }

 private:
  // One contiguous run of lights; each part is worked on by one thread at a time.
  struct Part {
    VisibleLights visible;
    LightBoxes boxes;
    FroxelPairs pairs;
    std::vector<uint32_t> next;  // per froxel: first the part's count, then where its next entry goes
  };
  void emit(Part& part, const BoundsConstants& constants, const ClusterSettings& settings,
            uint64_t max_entries) const;

  FroxelGrid grid_;
  BoxOffsets box_offsets_;
  RefinementPlanes planes_;
  std::vector<Part> parts_;
  std::vector<uint32_t> offsets_, indices_;
  size_t entries_ = 0;
  uint64_t in_frustum_ = 0;
};

}  // namespace ml
