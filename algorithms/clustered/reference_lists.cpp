#include "algorithms/clustered/reference_lists.h"

namespace ml {
namespace {

template <typename Visit>
void for_each_froxel(const FroxelBox& box, const FroxelGrid& grid, Visit visit) {
  if (box.empty()) return;
  for (uint32_t y = box.y0; y <= box.y1; ++y)
    for (uint32_t x = box.x0; x <= box.x1; ++x)
      for (uint32_t z = box.z0; z <= box.z1; ++z) visit((y * grid.columns + x) * grid.slices + z);
}

}  // namespace

void ReferenceLists::build(const FrameInput& frame, const ClusterSettings& settings) {
  grid_ = FroxelGrid::make(frame.view, settings.tile, settings.slices, settings.zmin, settings.zmax);
  const BoundsConstants constants(frame.view, grid_);
  scalar::cull(frame.lights, 0, frame.lights.count(), constants, visible_);
  boxes_.resize(visible_.count);
  for (size_t i = 0; i < visible_.count; ++i)
    boxes_[i] =
        scalar::bound_ball(constants, visible_.x[i], visible_.y[i], visible_.z[i], visible_.radius[i]);

  offsets_.assign(grid_.cells() + size_t{1}, 0);
  for (const FroxelBox& box : boxes_)
    for_each_froxel(box, grid_, [&](uint32_t froxel) { ++offsets_[froxel + 1]; });
  for (uint32_t froxel = 0; froxel < grid_.cells(); ++froxel) offsets_[froxel + 1] += offsets_[froxel];
  next_.assign(offsets_.begin(), offsets_.end() - 1);
  indices_.resize(offsets_.back());
  for (size_t i = 0; i < visible_.count; ++i)
    for_each_froxel(boxes_[i], grid_,
                    [&](uint32_t froxel) { indices_[next_[froxel]++] = visible_.index[i]; });
}

}  // namespace ml
