// The lists of a froxel grid, from a frame's lights to one array: cull, [sort], bound, count, scatter. What
// clustered shading, light trees (one slice) and their hybrid have in common.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/froxels/binning.h"
#include "algorithms/froxels/depth_order.h"
#include "algorithms/froxels/refinement.h"

namespace ml {

struct FroxelSettings {
  // What a list's entries are, and what they ascend by: light indices, or ranks in the order of depth.
  enum class Order { index, depth };
  uint32_t tile = 24;  // px
  uint32_t slices = 16;
  float zmin = 5;  // m, end of the near slice
  float zmax = 0;  // m, 0: the view's far
  bool refinement = false;
  Order order = Order::index;
};

class FroxelLists {
 public:
  // `owner`: the algorithm's name for messages.
  explicit FroxelLists(std::string owner) : owner_(std::move(owner)) {}

  // Builds the lists of a frame; spans `cull`, `sort` (order by depth) and `bin`. Lists do not depend on the
  // number of threads. Throws SystemError when they would hold more than `max_entries`.
  void build(const FrameInput& frame, const FroxelSettings& settings, uint64_t max_entries, Spans& spans);

  const FroxelGrid& grid() const { return grid_; }
  // Where each froxel's list begins in entries(), and one more: the end of the last.
  std::span<const uint32_t> offsets() const { return std::span(offsets_).first(grid_.cells() + size_t{1}); }
  std::span<const uint32_t> entries() const { return std::span(list_).first(entries_); }
  uint64_t lights_in_frustum() const { return in_frustum_; }

  // Order by depth only: light index and depth range (m) of each rank.
  std::span<const uint32_t> light_of_rank() const { return order_.light_of_rank(); }
  const DepthRanges& depth_of_rank() const { return depth_of_rank_; }

 private:
  // One contiguous run of lights; each part is worked on by one thread at a time.
  struct Part {
    VisibleLights visible;
    LightBoxes boxes;
    FroxelPairs pairs;
    std::vector<uint32_t> next;  // per froxel: first the part's count, then where its next entry goes
  };
  void emit(const FrameLights& lights, Part& part, const VisibleRun& visible, size_t first_rank,
            const BoundsConstants& constants, const FroxelSettings& settings, uint64_t max_entries);
  [[noreturn]] void too_many(uint64_t entries, uint64_t limit) const;

  std::string owner_;
  FroxelGrid grid_;
  BoxOffsets box_offsets_;
  RefinementPlanes planes_;
  std::vector<Part> parts_;
  std::vector<const VisibleLights*> culled_;
  DepthOrder order_;
  VisibleLights sorted_;
  DepthRanges depth_of_rank_;
  std::vector<uint32_t> offsets_, list_;
  size_t entries_ = 0;
  uint64_t in_frustum_ = 0;
};

}  // namespace ml
