#include "algorithms/fine_pruned/visible_lights.h"

#include <algorithm>
#include <array>

namespace ml {
namespace {

// The whole depth is one slice.
FroxelGrid tile_grid(const gpu_data::ViewData& view) {
  return FroxelGrid::make(view, ML_PRUNED_TILE, 1, 5, 0);
}

constexpr size_t types = 6;

// Rank in the sequence of loops over lights (section 2.4); probe lights come after all direct ones.
size_t type_of(uint32_t id_shape) {
  const size_t first = id_shape & ML_LIGHT_PROBE ? types / 2 : 0;
  switch (id_shape >> 24) {
    case ML_SHAPE_SPOT:
    case ML_SHAPE_WEDGE:
      return first + 1;
    case ML_SHAPE_BOX:
      return first + 2;
    default:
      return first;
  }
}

}  // namespace

void VisibleLightList::cull(const FrameInput& frame, Spans& spans) {
  auto span = spans.span("cull");
  const BoundsConstants constants(frame.view, tile_grid(frame.view));
  visible_.reserve(frame.lights.count());
  visible_.count = simd::cull(frame.lights, 0, frame.lights.count(), constants, visible_);
}

void VisibleLightList::sort(const FrameInput& frame, uint32_t max_lights, Spans& spans) {
  auto span = spans.span("sort");
  std::array<uint32_t, types> counts{}, next{};
  for (size_t i = 0; i < visible_.count; ++i)
    ++counts[type_of(frame.lights.core[visible_.index[i]].id_shape)];
  for (size_t type = 1; type < types; ++type) next[type] = next[type - 1] + counts[type - 1];
  header_.count = std::min(in_frustum(), max_lights);
  header_.first_cone = std::min(next[1], max_lights);
  header_.first_box = std::min(next[2], max_lights);
  header_.first_probe = std::min(next[3], max_lights);
  header_.first_probe_cone = std::min(next[4], max_lights);
  header_.first_probe_box = std::min(next[5], max_lights);
  if (sorted_.size() < visible_.count) sorted_.resize(visible_.count);
  for (size_t i = 0; i < visible_.count; ++i) {
    const uint32_t light = visible_.index[i];
    sorted_[next[type_of(frame.lights.core[light].id_shape)]++] = light;
  }
}

uint64_t VisibleLightList::max_entries_of_tiles(const FrameInput& frame) {
  const FroxelGrid grid = tile_grid(frame.view);
  columns_ = grid.columns;
  rows_ = grid.rows;
  if (visible_.count == 0) return 0;
  reserve_padded(boxes_, visible_.count);
  return simd::bound(VisibleRun(visible_), BoundsConstants(frame.view, grid), boxes_.data());
}

uint32_t VisibleLightList::max_in_a_tile() {
  // A box adds one from its first column and row on and takes it away past its last; sums over columns and
  // rows are the numbers of boxes.
  const size_t stride = columns_ + size_t{1};
  changes_.assign(stride * (rows_ + size_t{1}), 0);
  for (size_t i = 0; i < visible_.count; ++i) {
    const LightBox& box = boxes_[i];
    if (box.columns == 0) continue;
    const size_t row = box.first / columns_, column = box.first % columns_;
    ++changes_[row * stride + column];
    --changes_[row * stride + column + box.columns];
    --changes_[(row + box.rows) * stride + column];
    ++changes_[(row + box.rows) * stride + column + box.columns];
  }
  int32_t max_boxes = 0;
  for (size_t row = 0; row < rows_; ++row) {
    int32_t across = 0;
    for (size_t column = 0; column < columns_; ++column) {
      // changes_ of the row above are already sums over rows.
      int32_t& change = changes_[row * stride + column];
      if (row > 0) change += changes_[(row - 1) * stride + column];
      across += change;
      max_boxes = std::max(max_boxes, across);
    }
  }
  return static_cast<uint32_t>(max_boxes);
}

}  // namespace ml
