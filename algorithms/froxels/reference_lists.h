// Binning as the papers describe it (Persson 2013; Tiled Light Trees 2017, sections 3.2 and 4.1), in plain
// scalar code: the oracle of the fast path's tests and the baseline of its benchmarks.
#pragma once

#include "algorithms/froxels/froxel_lists.h"

namespace ml {

class ReferenceLists {
 public:
  // For each light in view its box of froxels; a first walk over the boxes counts, a second scatters. Ordered
  // by depth, a radix sort of the lights comes first. No refinement.
  // Spans cull, sort (order by depth) and bin.
  void build(const FrameInput& frame, const FroxelSettings& settings, Spans& spans);
  void build(const FrameInput& frame, const FroxelSettings& settings) {
    Spans unread;
    build(frame, settings, unread);
  }

  const FroxelGrid& grid() const { return grid_; }
  const std::vector<uint32_t>& offsets() const { return offsets_; }  // one more than froxels
  // Light indices, or ranks when ordered by depth.
  const std::vector<uint32_t>& entries() const { return entries_; }

  // Order by depth only: light index and depth range (m) of each rank.
  const std::vector<uint32_t>& light_of_rank() const { return light_of_rank_; }
  const std::vector<DepthInterval>& depth_of_rank() const { return depth_of_rank_; }

 private:
  void sort_by_depth(const DepthKey& key);
  void tighten_shapes(const FrameLights& all, const BoundsConstants& constants, const VisibleLights& lights,
                      bool by_depth);

  FroxelGrid grid_;
  VisibleLights visible_, sorted_;
  std::vector<FroxelBox> boxes_;
  std::vector<uint32_t> offsets_, next_, entries_;
  std::vector<uint32_t> keys_, order_, scratch_, light_of_rank_;
  std::vector<DepthInterval> depth_of_rank_;
};

}  // namespace ml
