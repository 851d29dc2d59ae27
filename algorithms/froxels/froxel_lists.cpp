#include "algorithms/froxels/froxel_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "algorithms/froxels/shape_bounds.h"
#include "harness/base/error.h"

namespace ml {
namespace {

// A part is worth a thread only when it has some thousand lights.
constexpr size_t lights_per_part = 2048;
// Lists of fewer entries stay in the caches that are near.
constexpr size_t few_entries = 400000;

}  // namespace

void FroxelLists::too_many(uint64_t entries, uint64_t limit) const {
  throw SystemError(fmt::format(
      "{}: the froxel lists would hold {} entries, the device's buffer {}; use fewer lights, larger tiles or "
      "fewer slices",
      owner_, entries, limit));
}

void FroxelLists::cull(const FrameInput& frame, bool by_depth, const BoundsConstants& constants) {
  const size_t lights = frame.lights.count();
  const size_t parts = std::clamp<size_t>(lights / lights_per_part, 1, frame.threads->count());
  if (parts_.size() < parts) parts_.resize(parts);
  visible_.reserve(lights);
  if (by_depth) reserve_padded(reaches_, lights);
  runs_.resize(parts);
  frame.threads->for_each(parts, [&](size_t p) {
    auto begin_of = [&](size_t part) {
      return part == parts ? lights : lights * part / parts / vector_padding * vector_padding;
    };
    const size_t begin = begin_of(p);
    runs_[p] = {begin, simd::cull(frame.lights, begin, begin_of(p + 1), constants, visible_,
                                  by_depth ? reaches_.data() : nullptr)};
  });
  in_frustum_ = 0;
  for (const IndexRun& run : runs_) in_frustum_ += run.count;
}

void FroxelLists::bound(const FrameLights& lights, size_t p, bool by_depth,
                        const BoundsConstants& constants) {
  const IndexRun run = runs_[p];
  const VisibleRun visible(visible_, run.first, run.first + run.count);
  LightBox* boxes = &boxes_[run.first];
  uint64_t froxels = simd::bound(visible, constants, boxes);
  for (size_t i = 0; i < run.count && !lights.extra.empty(); ++i) {
    const uint32_t light = visible.index[i];
    const gpu_data::LightCore& core = lights.core[light];
    if (core.id_shape >> 24 == ML_SHAPE_OMNI) continue;
    DepthInterval depth = scalar::depth_interval(visible.z[i], visible.radius[i]);
    froxels -= boxes[i].froxels();
    tighten(constants, core, lights.extra[light], boxes[i], depth);
    froxels += boxes[i].froxels();
    if (by_depth) reaches_[light] = {-depth.low, depth.high};
  }
  parts_[p].froxels = froxels;
}

void FroxelLists::emit(size_t p, const FroxelSettings& settings, const BoundsConstants& constants,
                       uint64_t max_entries) {
  const bool by_depth = settings.order == FroxelSettings::Order::depth;
  const bool narrowed = settings.refinement || settings.ball_test;
  Part& part = parts_[p];
  const LightBox* boxes = boxes_.data();
  size_t first = runs_[p].first, count = runs_[p].count;
  const uint32_t* indices = nullptr;
  if (by_depth) {
    first = in_frustum_ * p / runs_.size();
    count = in_frustum_ * (p + 1) / runs_.size() - first;
    indices = order_.indices().data() + first;
    first = 0;
    if (runs_.size() > 1) part.froxels = count_pairs(boxes, indices, count);
  }
  const uint64_t pairs = part.froxels;
  if (pairs > max_entries && !narrowed) too_many(pairs, max_entries);
  // Narrowing leaves out about a tenth; demand far beyond the limit is refused before memory is taken for
  // it.
  if (pairs > 4 * max_entries) too_many(pairs, max_entries);
  reserve_pairs(part.pairs, pairs, chords_);
  if (settings.ball_test)
    simd::emit_tested(visible_, boxes_.data(), indices, first, count, constants, ball_test_, box_offsets_,
                      chords_ ? reaches_.data() : nullptr, part.pairs);
  else if (settings.refinement)
    emit_refined(visible_, boxes_.data(), indices, first, count, constants, planes_, part.pairs);
  else
    simd::emit(boxes + first, indices, count, grid_, box_offsets_, part.pairs);
  part.next.assign(grid_.cells(), 0);
  for (size_t i = 0; i < part.pairs.count; ++i) ++part.next[part.pairs.cell[i]];
}

void FroxelLists::begin_list(uint64_t entries, UploadMemory* memory, uint32_t slot) {
  entries_ = entries;
  reserve_padded(offsets_, grid_.cells() + size_t{1});
  if (memory) {
    const std::span<std::byte> mapped = memory->map(slot, entries * sizeof(uint32_t));
    if (memory->cached(slot)) {
      list_ = {reinterpret_cast<uint32_t*>(mapped.data()), entries};
      return;
    }
  }
  reserve_padded(own_list_, entries);
  list_ = own_list_;
}

void FroxelLists::upload_entries(UploadMemory& memory, uint32_t slot) const {
  if (list_.data() != own_list_.data()) return;
  // Whole words, of which the last may be half used.
  const std::span<std::byte> mapped = memory.map(slot, (entry_bytes() + 3) / 4 * 4);
  if (narrow_) {
    auto* to = reinterpret_cast<uint16_t*>(mapped.data());
    for (const uint32_t light : entries()) *to++ = static_cast<uint16_t>(light);
    if (entries_ % 2 != 0) *to = 0;
  } else if (!entries().empty()) {
    std::memcpy(mapped.data(), entries().data(), entries().size_bytes());
  }
}

gpu_data::FroxelGridData FroxelLists::grid_data() const {
  gpu_data::FroxelGridData data = grid_.data();
  data.narrow = narrow_;
  return data;
}

bool FroxelLists::list_rows(const FrameInput& frame, bool by_depth, uint64_t max_entries,
                            UploadMemory* memory, uint32_t slot) {
  const uint64_t pairs = parts_[0].froxels;
  const size_t light_end = frame.lights.count();
  if (!rows_are_cheaper(boxes_.data(), in_frustum_, pairs, grid_, light_end)) return false;
  if (pairs > max_entries) too_many(pairs, max_entries);
  begin_list(pairs, memory, slot);
  longest_ = simd::list_rows(boxes_.data(), by_depth ? order_.indices().data() : nullptr, in_frustum_, grid_,
                             light_end, row_memory_, offsets_.data(), list_.data());
  return true;
}

// Within a froxel the entries of part 0 come first, so that lists ascend.
void FroxelLists::scatter(Threads& threads) {
  const size_t parts = runs_.size();
  uint32_t running = 0;
  longest_ = 0;
  for (uint32_t cell = 0; cell < grid_.cells(); ++cell) {
    offsets_[cell] = running;
    for (size_t p = 0; p < parts; ++p) {
      uint32_t& next = parts_[p].next[cell];
      running += next;
      next = running - next;
    }
    longest_ = std::max(longest_, running - offsets_[cell]);
  }
  offsets_[grid_.cells()] = running;
  if (chords_) reserve_padded(entry_reaches_, entries_);
  threads.for_each(parts, [&](size_t p) {
    if (chords_)
      scatter_part<true>(p);
    else
      scatter_part<false>(p);
  });
}

template <bool with_reaches>
void FroxelLists::scatter_part(size_t part) {
  const FroxelPairs& pairs = parts_[part].pairs;
  uint32_t* next = parts_[part].next.data();
  const auto scatter = [&](size_t i) {
    const uint32_t entry = next[pairs.cell[i]]++;
    list_[entry] = pairs.light[i];
    if constexpr (with_reaches) entry_reaches_[entry] = {pairs.minus_low[i], pairs.high[i]};
  };
  if (entries_ < few_entries) {
    for (size_t i = 0; i < pairs.count; ++i) scatter(i);
    return;
  }
  // Lights in the order of depth fill the lists nearly from front to back: what they will come to in a
  // slice or two is asked for, a cache line at a time.
  constexpr size_t line = 16;
  size_t ahead = 2 * entries_ / grid_.slices;
  for (size_t before = 0; before < part; ++before) ahead += parts_[before].pairs.count;
  for (size_t begin = 0; begin < pairs.count; begin += line) {
    const size_t asked = std::min(begin + ahead, entries_);
    __builtin_prefetch(&list_[asked], 1);
    if constexpr (with_reaches) {
      __builtin_prefetch(&entry_reaches_[asked], 1);
      __builtin_prefetch(&entry_reaches_[asked + line / 2], 1);
    }
    const size_t end = std::min(begin + line, pairs.count);
    for (size_t i = begin; i < end; ++i) scatter(i);
  }
}

void FroxelLists::build(const FrameInput& frame, const FroxelSettings& settings, uint64_t max_entries,
                        UploadMemory* memory, uint32_t slot, Spans& spans) {
  grid_ = FroxelGrid::make(frame.view, settings.tile, settings.slices, settings.zmin, settings.zmax);
  const BoundsConstants constants(frame.view, grid_);
  const bool by_depth = settings.order == FroxelSettings::Order::depth;
  narrow_ = narrows(frame, settings);
  chords_ = settings.chords && settings.ball_test && by_depth;
  {
    auto span = spans.span("cull");
    cull(frame, by_depth, constants);
  }
  Threads& threads = *frame.threads;
  if (by_depth) {
    auto span = spans.span("sort");
    order_.sort(visible_.z.data(), runs_, DepthKey(frame.view), threads);
  }
  auto span = spans.span("bin");
  box_offsets_.build(grid_);
  if (settings.ball_test)
    ball_test_.build(constants);
  else if (settings.refinement)
    planes_.build(constants);
  reserve_padded(boxes_, frame.lights.count());
  threads.for_each(runs_.size(), [&](size_t p) { bound(frame.lights, p, by_depth, constants); });
  by_rows_ = runs_.size() == 1 && !settings.refinement && !settings.ball_test &&
             list_rows(frame, by_depth, max_entries, memory, slot);
  if (by_rows_) return;
  threads.for_each(runs_.size(), [&](size_t p) { emit(p, settings, constants, max_entries); });
  uint64_t entries = 0;
  for (size_t p = 0; p < runs_.size(); ++p) entries += parts_[p].pairs.count;
  if (entries > max_entries) too_many(entries, max_entries);
  begin_list(entries, memory, slot);
  scatter(threads);
}

}  // namespace ml
