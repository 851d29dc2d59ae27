#include "algorithms/froxels/froxel_lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "algorithms/froxels/shape_bounds.h"
#include "harness/base/error.h"

namespace ml {
namespace {

// A part is worth a thread only when it has some thousand lights.
constexpr size_t lights_per_part = 2048;
// Runs of sorted lights begin at multiples of this, so that whole vectors never reach into the next run.
constexpr size_t run_alignment = 64;

}  // namespace

void FroxelLists::too_many(uint64_t entries, uint64_t limit) const {
  throw SystemError(fmt::format(
      "{}: the froxel lists would hold {} entries, the device's buffer {}; use fewer lights, larger tiles or "
      "fewer slices",
      owner_, entries, limit));
}

// `first_rank`: rank of the run's first light, when ordered by depth.
void FroxelLists::emit(const FrameLights& lights, Part& part, const VisibleRun& visible, size_t first_rank,
                       const BoundsConstants& constants, const FroxelSettings& settings,
                       uint64_t max_entries) {
  simd::bound(visible, constants, part.boxes);
  const bool by_depth = settings.order == FroxelSettings::Order::depth;
  if (!lights.extra.empty())
    for (size_t i = 0; i < visible.count; ++i) {
      const uint32_t light = by_depth ? light_of_rank()[visible.index[i]] : visible.index[i];
      const gpu_data::LightCore& core = lights.core[light];
      if (core.id_shape >> 24 == ML_SHAPE_OMNI) continue;
      scalar::DepthInterval depth = scalar::depth_interval(visible.z[i], visible.radius[i]);
      tighten(constants, core, lights.extra[light], part.boxes, i, depth);
      if (!by_depth) continue;
      depth_of_rank_.low[first_rank + i] = depth.low;
      depth_of_rank_.high[first_rank + i] = depth.high;
    }
  uint64_t pairs = count_pairs(part.boxes, visible.count);
  if (pairs > max_entries && !settings.refinement) too_many(pairs, max_entries);
  // Refinement leaves out about a tenth; demand far beyond the limit is refused before memory is taken for
  // it.
  if (pairs > 4 * max_entries) too_many(pairs, max_entries);
  reserve_pairs(part.pairs, pairs);
  if (settings.refinement)
    emit_refined(visible, part.boxes, constants, planes_, part.pairs);
  else
    simd::emit(visible, part.boxes, grid_, box_offsets_, part.pairs);
  part.next.assign(grid_.cells(), 0);
  for (size_t i = 0; i < part.pairs.count; ++i) ++part.next[part.pairs.froxel[i]];
}

void FroxelLists::build(const FrameInput& frame, const FroxelSettings& settings, uint64_t max_entries,
                        Spans& spans) {
  grid_ = FroxelGrid::make(frame.view, settings.tile, settings.slices, settings.zmin, settings.zmax);
  const BoundsConstants constants(frame.view, grid_);
  const bool by_depth = settings.order == FroxelSettings::Order::depth;
  const size_t lights = frame.lights.count();
  const size_t parts = std::clamp<size_t>(lights / lights_per_part, 1, frame.threads->count());
  if (parts_.size() < parts) parts_.resize(parts);
  {
    auto span = spans.span("cull");
    frame.threads->for_each(parts, [&](size_t p) {
      size_t begin = lights * p / parts, end = lights * (p + 1) / parts;
      simd::cull(frame.lights, begin, end, constants, parts_[p].visible);
    });
    in_frustum_ = 0;
    for (size_t p = 0; p < parts; ++p) in_frustum_ += parts_[p].visible.count;
  }
  auto run_begin = [&](size_t p) {
    return p == parts ? in_frustum_ : in_frustum_ * p / parts / run_alignment * run_alignment;
  };
  if (by_depth) {
    auto span = spans.span("sort");
    culled_.clear();
    for (size_t p = 0; p < parts; ++p) culled_.push_back(&parts_[p].visible);
    order_.sort(culled_, sorted_, *frame.threads);
  }

  auto span = spans.span("bin");
  box_offsets_.build(grid_);
  if (settings.refinement) planes_.build(constants);
  if (by_depth) depth_of_rank_.reserve(in_frustum_);
  frame.threads->for_each(parts, [&](size_t p) {
    if (!by_depth)
      return emit(frame.lights, parts_[p], parts_[p].visible, 0, constants, settings, max_entries);
    VisibleRun run(sorted_, run_begin(p), run_begin(p + 1));
    simd::depth_ranges(run, &depth_of_rank_.low[run_begin(p)], &depth_of_rank_.high[run_begin(p)]);
    emit(frame.lights, parts_[p], run, run_begin(p), constants, settings, max_entries);
  });

  uint64_t total = 0;
  for (size_t p = 0; p < parts; ++p) total += parts_[p].pairs.count;
  if (total > max_entries) too_many(total, max_entries);
  entries_ = total;
  if (list_.size() < entries_) list_.resize(entries_ + entries_ / 4);
  if (offsets_.size() < grid_.cells() + size_t{1}) offsets_.resize(grid_.cells() + size_t{1});

  // Counting sort: within a froxel the entries of part 0 come first, so that lists ascend.
  uint32_t running = 0;
  for (uint32_t cell = 0; cell < grid_.cells(); ++cell) {
    offsets_[cell] = running;
    for (size_t p = 0; p < parts; ++p) {
      uint32_t count = parts_[p].next[cell];
      parts_[p].next[cell] = running;
      running += count;
    }
  }
  offsets_[grid_.cells()] = running;
  frame.threads->for_each(parts, [&](size_t p) {
    Part& part = parts_[p];
    for (size_t i = 0; i < part.pairs.count; ++i)
      list_[part.next[part.pairs.froxel[i]]++] = part.pairs.light[i];
  });
}

}  // namespace ml
