// Compiled once for every instruction set; the best one is chosen at run time (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/trees/tree_chunk.cpp"
#include "algorithms/trees/tree_chunk.h"

#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "harness/base/check.h"

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using gpu_data::TreeCell;
using gpu_data::TreeNode;
// No wider than a leaf of the usual eight lights, of two depths each.
using Floats = hn::CappedTag<float, 16>;
using Signed = hn::RebindToSigned<Floats>;
using VF = hn::Vec<Floats>;
using VI = hn::Vec<Signed>;

constexpr Floats df;
constexpr Signed ds;
constexpr float infinity = std::numeric_limits<float>::infinity();

HWY_INLINE uint32_t packed(bool leaf, uint32_t lights, uint32_t skip) {
  ML_DCHECK_LE(lights, ML_TREE_MAX_LEAF_LIGHTS);
  ML_DCHECK_LT(skip, 1u << 15);
  return (leaf ? ML_TREE_LEAF : 0) | lights << ML_TREE_COUNT_SHIFT | skip << ML_TREE_SKIP_SHIFT;
}

constexpr DepthReach nothing{-infinity, -infinity};

HWY_INLINE DepthReach either(DepthReach a, DepthReach b) {
  return {std::max(a.minus_low, b.minus_low), std::max(a.high, b.high)};
}
HWY_INLINE TreeNode node_of(DepthReach bounds, uint32_t first_or_below, uint32_t packed) {
  return {-bounds.minus_low, bounds.high, first_or_below, packed};
}

// Sum of parts of a cell's depth, in steps.
#if HWY_TARGET == HWY_SCALAR
struct StepSum {
  uint64_t sum = 0;
  void add(float steps) { sum += static_cast<uint64_t>(std::nearbyint(steps)); }
  uint64_t total() const { return sum; }
};

// Depth bounds of reaches[0..count); adds the parts inside `clip` to `sum`.
template <bool summed>
HWY_INLINE DepthReach leaf_reach(const DepthReach* reaches, uint32_t count, DepthReach clip, float steps,
                                 StepSum& sum) {
  DepthReach all = nothing;
  for (uint32_t i = 0; i < count; ++i) {
    all = either(all, reaches[i]);
    if (!summed) continue;
    const float inside =
        std::min(reaches[i].high, clip.high) + std::min(reaches[i].minus_low, clip.minus_low);
    sum.add(std::min(std::max(inside, 0.0f) * steps, max_extents * 65536));
  }
  return all;
}
#else
struct StepSum {
  VI lanes;
  // Every part is in two lanes, at most 2^20 in each: after this many parts all lanes together hold no more
  // than 2^31.
  static constexpr uint32_t max_parts = 1024;
  uint32_t added = 0;
  uint64_t sum = 0;
  HWY_INLINE StepSum() : lanes(hn::Zero(ds)) {}
  HWY_INLINE void reserve(uint32_t parts) {
    if (added + parts > max_parts) flush();
    added += parts;
  }
  HWY_INLINE void flush() {
    sum += static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(ds, lanes))) / 2;
    lanes = hn::Zero(ds);
    added = 0;
  }
  // Rounded by an addition that leaves no bits after the point: in [0, 2^22), to the nearest, ties to even.
  HWY_INLINE void add(VF steps) {
    const float point = 12582912.0f;
    const VI rounded = hn::BitCast(ds, hn::Add(steps, hn::Set(df, point)));
    lanes = hn::Add(lanes, hn::Sub(rounded, hn::Set(ds, std::bit_cast<int32_t>(point))));
  }
  HWY_INLINE uint64_t total() {
    flush();
    return sum;
  }
};

// The largest minus_low and high of the pairs in a vector.
template <class D>
HWY_INLINE DepthReach largest(D d, hn::Vec<D> pairs) {
  if constexpr (hn::MaxLanes(d) > 4) {
    const hn::Half<D> half;
    return largest(half, hn::Max(hn::LowerHalf(half, pairs), hn::UpperHalf(half, pairs)));
  } else {
    const auto all = hn::Max(pairs, hn::Shuffle1032(pairs));
    return {hn::GetLane(all), hn::GetLane(hn::Shuffle2301(all))};
  }
}

// The same, pairs side by side in the lanes: with the low end negated both ends are treated alike. Whole
// vectors are read, what is past the last light in vain.
template <bool summed>
HWY_INLINE DepthReach leaf_reach(const DepthReach* reaches, uint32_t count, DepthReach clip, float steps,
                                 StepSum& sum) {
  constexpr uint32_t pairs = static_cast<uint32_t>(hn::MaxLanes(df)) / 2;
  const VF none = hn::Set(df, -infinity), step = hn::Set(df, steps);
  const VF ends = hn::OddEven(hn::Set(df, clip.high), hn::Set(df, clip.minus_low));
  VF all = none;
  const auto add = [&](VF reach) HWY_ATTR {
    all = hn::Max(all, reach);
    if (!summed) return;
    const VF clipped = hn::Min(reach, ends);
    const VF inside = hn::Max(hn::Add(clipped, hn::Shuffle2301(clipped)), hn::Zero(df));
    sum.add(hn::Min(hn::Mul(inside, step), hn::Set(df, max_extents * 65536)));
  };
  if (summed) sum.reserve(count);
  uint32_t i = 0;
  // Whole leaves of the usual eight lights have no mask, and no loop where a vector has 16 lanes.
  for (; i + pairs <= count; i += pairs) add(hn::LoadU(df, &reaches[i].minus_low));
  if (i < count)
    add(hn::IfThenElse(hn::FirstN(df, 2 * (count - i)), hn::LoadU(df, &reaches[i].minus_low), none));
  return largest(df, all);
}
#endif

// Bounds of every leaf's lights into bounds[leaf]; returns the sum of all lights' depths, clipped to the cell
// or not, in steps.
HWY_INLINE uint64_t bound_leaves(const DepthReach* reaches, uint32_t count, uint32_t per_leaf,
                                 FroxelGrid::DepthRange extent, bool clipped, DepthReach* bounds) {
  const DepthReach clip = clipped ? DepthReach{-extent.low, extent.high} : DepthReach{infinity, infinity};
  const float steps = extent_steps(extent);
  StepSum sum;
  for (uint32_t begin = 0; begin < count; begin += per_leaf)
    *bounds++ = leaf_reach<true>(reaches + begin, std::min(per_leaf, count - begin), clip, steps, sum);
  return sum.total();
}

// The depths of the first `count` of some lights one after the other.
HWY_INLINE void collect(std::span<const uint32_t> lights, size_t count, const DepthReach* reach_of_light,
                        DepthReach* reaches) {
  // They lie anywhere in memory, and which comes is known long before.
  constexpr size_t ahead = 32;
  const size_t known = lights.size() < ahead ? 0 : std::min(count, lights.size() - ahead);
  for (size_t i = 0; i < known; ++i) {
    hwy::Prefetch(&reach_of_light[lights[i + ahead]]);
    std::memcpy(&reaches[i], &reach_of_light[lights[i]], sizeof *reaches);
  }
  for (size_t i = known; i < count; ++i)
    std::memcpy(&reaches[i], &reach_of_light[lights[i]], sizeof *reaches);
}

// What a list is: one leaf, or where its count field is too small several, one after the other.
HWY_INLINE size_t write_list(const DepthReach* bounds, uint32_t lights, uint32_t first, uint32_t per_leaf,
                             TreeNode* nodes) {
  size_t count = 0;
  const uint32_t max_part = ML_TREE_MAX_LEAF_LIGHTS / per_leaf * per_leaf;
  for (uint32_t begin = 0; begin < lights; begin += max_part) {
    const uint32_t part = std::min(lights - begin, max_part);
    DepthReach all = nothing;
    for (uint32_t leaf = begin / per_leaf; leaf * per_leaf < begin + part; ++leaf)
      all = either(all, bounds[leaf]);
    nodes[count++] = node_of(all, first + begin, packed(true, part, 1));
  }
  return count;
}

// The nodes without lights that fill up a tree.
void write_padding(uint32_t height, uint32_t lights, uint32_t per_leaf, TreeNode* nodes) {
  for (uint32_t level = 0; level <= height; ++level) {
    const uint32_t used = (lights - 1) / (per_leaf << (height - level)) + 1;
    const uint32_t word = packed(level == height, 0, (2u << (height - level)) - 1);
    for (uint32_t index = used; index < 1u << level; ++index)
      nodes[depth_first_index(height, level, index)] = node_of(nothing, 0, word);
  }
}

// Bottom-up from the leaves' bounds, every level from the one below it and in its place; each node goes to
// its depth-first index. Of `bounds` there is one more than leaves. Returns the number of nodes.
HWY_INLINE size_t write_tree(DepthReach* bounds, uint32_t lights, uint32_t first, uint32_t per_leaf,
                             bool trim, TreeNode* nodes) {
  uint32_t used = (lights + per_leaf - 1) / per_leaf;
  const uint32_t leaves = std::bit_ceil(used);
  const auto height = static_cast<uint32_t>(std::countr_zero(leaves));
  ML_DCHECK_LE(leaves, ML_TREE_MAX_LEAVES);
  const size_t trimmed = depth_first_index(height, height, used - 1) + 1;
  for (uint32_t leaf = 0; leaf < used; ++leaf)
    nodes[depth_first_index(height, height, leaf)] =
        node_of(bounds[leaf], first + leaf * per_leaf, packed(true, per_leaf, 1));
  nodes[trimmed - 1].packed = packed(true, lights - (used - 1) * per_leaf, 1);
  uint32_t lights_below = per_leaf;
  for (uint32_t level = height; level-- > 0;) {
    lights_below *= 2;
    const uint32_t word = packed(false, 0, (2u << (height - level)) - 1);
    bounds[used] = nothing;
    used = (used + 1) / 2;
    for (uint32_t index = 0; index < used; ++index) {
      bounds[index] = either(bounds[2 * index], bounds[2 * index + 1]);
      nodes[depth_first_index(height, level, index)] = node_of(bounds[index], lights_below, word);
    }
    nodes[depth_first_index(height, level, used - 1)].first_or_below = lights - (used - 1) * lights_below;
  }
  if (trim) return trimmed;
  write_padding(height, lights, per_leaf, nodes);
  return 2 * leaves - 1;
}

// A row of cells, whose lists begin at the offsets, as lists.
struct ListRow {
  uint32_t longest = 0;  // the largest number of lights in a cell
  uint32_t filled = 0;   // cells with lights
};
HWY_INLINE ListRow write_lists(const uint32_t* offsets, uint32_t count, TreeCell* cells) {
  // No wider than cells of a row usually are.
  const hn::CappedTag<uint32_t, 8> du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  const auto flag = hn::Set(du, ML_TREE_CELL_LIST);
  auto longest = hn::Zero(du), filled = hn::Zero(du);
  uint32_t c = 0;
  for (; c + lanes <= count; c += lanes) {
    const auto first = hn::LoadU(du, offsets + c);
    const auto lights = hn::Sub(hn::LoadU(du, offsets + c + 1), first);
    const auto empty = hn::Eq(lights, hn::Zero(du));
    longest = hn::Max(longest, lights);
    filled = hn::Add(filled, hn::IfThenZeroElse(empty, hn::Set(du, 1)));
    hn::StoreInterleaved2(hn::IfThenZeroElse(empty, first), hn::IfThenZeroElse(empty, hn::Or(lights, flag)),
                          du, &cells[c].first);
  }
  ListRow row{hn::GetLane(hn::MaxOfLanes(du, longest)), hn::GetLane(hn::SumOfLanes(du, filled))};
  for (; c < count; ++c) {
    const uint32_t lights = offsets[c + 1] - offsets[c];
    row.longest = std::max(row.longest, lights);
    row.filled += lights > 0;
    cells[c] = lights > 0 ? TreeCell{offsets[c], ML_TREE_CELL_LIST | lights} : TreeCell{0, 0};
  }
  return row;
}

void build_chunk(const FroxelLists& lists, const TreeSettings& settings,
                 std::span<const FroxelGrid::DepthRange> cell_depths, TreeCell* cells, TreeChunk& chunk) {
  const uint32_t columns = lists.grid().columns, tiles = lists.grid().tiles();
  const uint32_t* offsets = lists.offsets().data();
  const std::span<const uint32_t> entries = lists.entries();
  const DepthReach* reach_of_light = lists.reach_of_light().data();
  const std::span<const DepthReach> reach_of_entry = lists.reach_of_entry();
  const uint32_t short_list = settings.short_list();
  reserve_padded(chunk.bounds, lists.longest() / settings.lights_per_leaf + 2);
  reserve_padded(chunk.node_tiles, chunk.end_cell - chunk.first_cell);
  DepthReach* bounds = chunk.bounds.data();
  StepSum unused;
  size_t count = 0;
  uint64_t filled = 0;
  chunk.tree_cells = 0;
  chunk.node_cells = 0;
  // A row of froxels at a time, or the part of it that is the chunk's.
  for (uint32_t row_cell = chunk.first_cell, row_end; row_cell < chunk.end_cell; row_cell = row_end) {
    row_end = std::min(row_cell + columns - row_cell % columns, chunk.end_cell);
    const ListRow row = write_lists(offsets + row_cell, row_end - row_cell, cells + row_cell);
    filled += row.filled;
    // No depth matters where all cells are short lists.
    if (row.longest <= short_list && !settings.list_nodes) continue;
    const FroxelGrid::DepthRange extent = cell_depths[row_cell / tiles];
    const uint32_t row_first = offsets[row_cell];
    const size_t row_lights = offsets[row_end] - row_first;
    const DepthReach* reaches = nullptr;
    if (reach_of_entry.empty()) {
      reserve_padded(chunk.reaches, row_lights);
      collect(entries.subspan(row_first), row_lights, reach_of_light, chunk.reaches.data());
      reaches = chunk.reaches.data();
    } else {
      reaches = reach_of_entry.data() + row_first;
    }
    for (uint32_t cell = row_cell; cell < row_end; ++cell) {
      const uint32_t first = offsets[cell], lights = offsets[cell + 1] - first;
      if (lights <= short_list && !(settings.list_nodes && lights > 0)) continue;
      TreeNode* nodes = chunk.nodes + count;
      size_t written = 0;
      if (lights > short_list) {
        const uint32_t per_leaf = leaf_size(settings.lights_per_leaf, lights);
        const uint64_t sum =
            bound_leaves(reaches + (first - row_first), lights, per_leaf, extent, settings.clipped, bounds);
        if (lights > per_leaf && is_tree(sum, lights, settings.threshold)) {
          written = write_tree(bounds, lights, first, per_leaf, settings.trim_padding, nodes);
          ++chunk.tree_cells;
        } else if (settings.list_nodes) {
          written = write_list(bounds, lights, first, per_leaf, nodes);
        }
      } else {
        const DepthReach all = leaf_reach<false>(reaches + (first - row_first), lights, {}, 0, unused);
        *nodes = node_of(all, first, packed(true, lights, 1));
        written = 1;
      }
      if (written == 0) continue;
      cells[cell] = {static_cast<uint32_t>(count), static_cast<uint32_t>(count + written)};
      chunk.node_tiles[chunk.node_cells++] = cell % tiles;
      count += written;
    }
  }
  chunk.list_cells = filled - chunk.tree_cells;
  chunk.count = count;
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml::simd {

HWY_EXPORT(build_chunk);

void build_chunk(const FroxelLists& lists, const TreeSettings& settings,
                 std::span<const FroxelGrid::DepthRange> cell_depths, gpu_data::TreeCell* cells,
                 TreeChunk& chunk) {
  HWY_DYNAMIC_DISPATCH(build_chunk)(lists, settings, cell_depths, cells, chunk);
}

}  // namespace ml::simd
#endif
