#include "algorithms/froxels/reference_lists.h"

#include <array>
#include <numeric>
#include <utility>

#include "algorithms/froxels/shape_bounds.h"

namespace ml {
namespace {

template <typename Visit>
void for_each_froxel(const FroxelBox& box, const FroxelGrid& grid, Visit visit) {
  if (box.empty()) return;
  for (uint32_t y = box.y0; y <= box.y1; ++y)
    for (uint32_t x = box.x0; x <= box.x1; ++x)
      for (uint32_t z = box.z0; z <= box.z1; ++z) visit(grid.cell(x, y, z));
}

}  // namespace

// Least significant byte first; stable.
void ReferenceLists::sort_by_depth(const DepthKey& key_of) {
  const size_t count = visible_.count;
  keys_.resize(count);
  order_.resize(count);
  scratch_.resize(count);
  for (size_t i = 0; i < count; ++i) keys_[i] = key_of(visible_.z[i]);
  std::iota(order_.begin(), order_.end(), 0u);
  for (uint32_t shift = 0; shift < DepthKey::bits; shift += 8) {
    std::array<uint32_t, 256> next{};
    for (uint32_t key : keys_) ++next[key >> shift & 255];
    uint32_t running = 0;
    for (uint32_t& begin : next) running += std::exchange(begin, running);
    for (uint32_t i : order_) scratch_[next[keys_[i] >> shift & 255]++] = i;
    order_.swap(scratch_);
  }
  sorted_.reserve(count);
  light_of_rank_.resize(count);
  depth_of_rank_.resize(count);
  for (size_t rank = 0; rank < count; ++rank) {
    uint32_t i = order_[rank];
    sorted_.x[rank] = visible_.x[i];
    sorted_.y[rank] = visible_.y[i];
    sorted_.z[rank] = visible_.z[i];
    sorted_.radius[rank] = visible_.radius[i];
    sorted_.index[rank] = static_cast<uint32_t>(rank);
    light_of_rank_[rank] = visible_.index[i];
    depth_of_rank_[rank] = scalar::depth_interval(visible_.z[i], visible_.radius[i]);
  }
  sorted_.count = count;
}

void ReferenceLists::tighten_shapes(const FrameLights& all, const BoundsConstants& constants,
                                    const VisibleLights& lights, bool by_depth) {
  for (size_t i = 0; i < lights.count; ++i) {
    const uint32_t light = by_depth ? light_of_rank_[i] : lights.index[i];
    FroxelBox& box = boxes_[i];
    if (all.core[light].id_shape >> 24 == ML_SHAPE_OMNI) continue;
    DepthInterval depth = scalar::depth_interval(lights.z[i], lights.radius[i]);
    if (!box.empty()) {
      auto narrow = [](uint32_t value) { return static_cast<uint16_t>(value); };
      LightBox one{grid_.cell(box.x0, box.y0, box.z0), light, narrow(box.x1 - box.x0 + 1u),
                   narrow(box.y1 - box.y0 + 1u), box.z1 - box.z0 + 1u};
      tighten(constants, all.core[light], all.extra[light], one, depth);
      if (one.columns == 0) {
        box = {};
      } else {
        const uint32_t x = one.first % grid_.columns, y = one.first / grid_.columns % grid_.rows,
                       z = one.first / grid_.columns / grid_.rows;
        box = {narrow(x), narrow(x + one.columns - 1), narrow(y), narrow(y + one.rows - 1),
               narrow(z), narrow(z + one.slices - 1)};
      }
    }
    if (by_depth) depth_of_rank_[i] = depth;
  }
}

void ReferenceLists::build(const FrameInput& frame, const FroxelSettings& settings, Spans& spans) {
  grid_ = FroxelGrid::make(frame.view, settings.tile, settings.slices, settings.zmin, settings.zmax);
  const BoundsConstants constants(frame.view, grid_);
  {
    auto span = spans.span("cull");
    visible_.reserve(frame.lights.count());
    visible_.count = scalar::cull(frame.lights, 0, frame.lights.count(), constants, visible_);
  }
  const bool by_depth = settings.order == FroxelSettings::Order::depth;
  if (by_depth) {
    auto span = spans.span("sort");
    sort_by_depth(DepthKey(frame.view));
  }
  auto span = spans.span("bin");
  const VisibleLights& lights = by_depth ? sorted_ : visible_;
  boxes_.resize(lights.count);
  for (size_t i = 0; i < lights.count; ++i)
    boxes_[i] = scalar::bound_ball(constants, lights.x[i], lights.y[i], lights.z[i], lights.radius[i]);
  if (!frame.lights.extra.empty()) tighten_shapes(frame.lights, constants, lights, by_depth);

  offsets_.assign(grid_.cells() + size_t{1}, 0);
  for (const FroxelBox& box : boxes_)
    for_each_froxel(box, grid_, [&](uint32_t froxel) { ++offsets_[froxel + 1]; });
  for (uint32_t froxel = 0; froxel < grid_.cells(); ++froxel) offsets_[froxel + 1] += offsets_[froxel];
  next_.assign(offsets_.begin(), offsets_.end() - 1);
  entries_.resize(offsets_.back());
  for (size_t i = 0; i < lights.count; ++i)
    for_each_froxel(boxes_[i], grid_, [&](uint32_t froxel) { entries_[next_[froxel]++] = lights.index[i]; });
}

}  // namespace ml
