#include "algorithms/clustered/cluster_lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"

namespace ml {
namespace {

[[noreturn]] void too_many(uint64_t entries, uint64_t limit) {
  throw SystemError(fmt::format(
      "clustered: the froxel lists would hold {} entries, the device's buffer {}; use fewer lights, larger "
      "tiles or fewer slices",
      entries, limit));
}

}  // namespace

void ClusterLists::emit(Part& part, const BoundsConstants& constants, const ClusterSettings& settings,
                        uint64_t max_entries) const {
  simd::bound(part.visible, constants, part.boxes);
  uint64_t pairs = count_pairs(part.boxes, part.visible.count);
  if (pairs > max_entries && !settings.refinement) too_many(pairs, max_entries);
  // Refinement leaves out about a tenth; demand far beyond the limit is refused before memory is taken for
  // it.
  if (pairs > 4 * max_entries) too_many(pairs, max_entries);
  reserve_pairs(part.pairs, pairs);
  if (settings.refinement)
    emit_refined(part.visible, part.boxes, constants, planes_, part.pairs);
  else
    simd::emit(part.visible, part.boxes, grid_, box_offsets_, part.pairs);
  part.next.assign(grid_.cells(), 0);
  for (size_t i = 0; i < part.pairs.count; ++i) ++part.next[part.pairs.froxel[i]];
}

void ClusterLists::build(const FrameInput& frame, const ClusterSettings& settings, uint64_t max_entries,
                         Spans& spans) {
  grid_ = FroxelGrid::make(frame.view, settings.tile, settings.slices, settings.zmin, settings.zmax);
  const BoundsConstants constants(frame.view, grid_);
  const size_t lights = frame.lights.count();
  // A part is worth a thread only when it has some thousand lights.
  const size_t parts = std::clamp<size_t>(lights / 2048, 1, frame.threads->count());
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
  auto span = spans.span("bin");
  box_offsets_.build(grid_);
  if (settings.refinement) planes_ = RefinementPlanes(constants);
  frame.threads->for_each(parts, [&](size_t p) { emit(parts_[p], constants, settings, max_entries); });

  uint64_t total = 0;
  for (size_t p = 0; p < parts; ++p) total += parts_[p].pairs.count;
  if (total > max_entries) too_many(total, max_entries);
  entries_ = total;
  if (indices_.size() < entries_) indices_.resize(entries_ + entries_ / 4);
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
      indices_[part.next[part.pairs.froxel[i]]++] = part.pairs.light[i];
  });
}

}  // namespace ml
