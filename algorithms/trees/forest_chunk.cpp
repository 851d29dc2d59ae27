// Compiled once for every instruction set; the best one is chosen at run time (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/trees/forest_chunk.cpp"
#include "algorithms/trees/forest_chunk.h"

#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using gpu_data::TreeCell;
using gpu_data::TreeNode;
// No wider than a leaf of the usual eight lights.
using Floats = hn::CappedTag<float, 8>;
using Signed = hn::RebindToSigned<Floats>;
using VF = hn::Vec<Floats>;
using VI = hn::Vec<Signed>;

constexpr Floats df;
constexpr Signed ds;
constexpr float infinity = std::numeric_limits<float>::infinity();

HWY_INLINE uint32_t packed(bool leaf, uint32_t lights, uint32_t skip) {
  assert(lights <= ML_TREE_MAX_LEAF_LIGHTS && skip < 1u << 15);
  return (leaf ? ML_TREE_LEAF : 0) | lights << ML_TREE_COUNT_SHIFT | skip << ML_TREE_SKIP_SHIFT;
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
  DepthReach all{-infinity, -infinity};
  for (uint32_t i = 0; i < count; ++i) {
    all.minus_low = std::max(all.minus_low, reaches[i].minus_low);
    all.high = std::max(all.high, reaches[i].high);
    if (!summed) continue;
    const float inside =
        std::min(reaches[i].high, clip.high) + std::min(reaches[i].minus_low, clip.minus_low);
    sum.add(std::max(inside, 0.0f) * steps);
  }
  return all;
}
#else
struct StepSum {
  VI lanes;
  // Every part is in two lanes, at most 65536 in each: after this many parts lanes hold no more than 2^30.
  static constexpr uint32_t most = 16384;
  uint32_t added = 0;
  uint64_t sum = 0;
  HWY_INLINE StepSum() : lanes(hn::Zero(ds)) {}
  HWY_INLINE void reserve(uint32_t parts) {
    if (added + parts > most) flush();
    added += parts;
  }
  HWY_INLINE void flush() {
    sum += static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(ds, lanes))) / 2;
    lanes = hn::Zero(ds);
    added = 0;
  }
  // Rounded by an addition that leaves no bits behind the point: in [0, 2^22), to the nearest, ties to even.
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

// The same, pairs side by side in the lanes: with the low end negated both ends are treated alike. Whole
// vectors are read, what is behind the last light in vain.
template <bool summed>
HWY_INLINE DepthReach leaf_reach(const DepthReach* reaches, uint32_t count, DepthReach clip, float steps,
                                 StepSum& sum) {
  constexpr uint32_t pairs = static_cast<uint32_t>(hn::MaxLanes(df)) / 2;
  const VF nothing = hn::Set(df, -infinity), step = hn::Set(df, steps);
  const VF ends = hn::OddEven(hn::Set(df, clip.high), hn::Set(df, clip.minus_low));
  VF all = nothing;
  if (summed) sum.reserve(count);
  // Eight lights at once, so that a leaf of no more has no loop.
  uint32_t i = 0;
  do {
    for (uint32_t k = i; k < i + 8; k += pairs) {
      const uint32_t left = count > k ? count - k : 0;
      const VF reach =
          hn::IfThenElse(hn::FirstN(df, 2 * left), hn::LoadU(df, &reaches[k].minus_low), nothing);
      all = hn::Max(all, reach);
      if (!summed) continue;
      const VF clipped = hn::Min(reach, ends);
      const VF inside = hn::Max(hn::Add(clipped, hn::Shuffle2301(clipped)), hn::Zero(df));
      sum.add(hn::Mul(inside, step));
    }
    i += 8;
  } while (i < count);
  all = hn::Max(all, hn::ReverseBlocks(df, all));
  all = hn::Max(all, hn::Shuffle1032(all));
  return {hn::GetLane(all), hn::GetLane(hn::Shuffle2301(all))};
}
#endif

// Bounds of every leaf's lights into chunk.low and chunk.high; returns the sum of all lights' depths clipped
// to the cell, in steps.
HWY_INLINE uint64_t bound_leaves(ForestChunk& chunk, const DepthReach* reaches, uint32_t count,
                                 uint32_t per_leaf, FroxelGrid::DepthRange extent) {
  const DepthReach clip{-extent.low, extent.high};
  const float steps = extent_steps(extent);
  StepSum sum;
  float *low = chunk.low.data(), *high = chunk.high.data();
  for (uint32_t begin = 0, leaf = 0; begin < count; begin += per_leaf, ++leaf) {
    const DepthReach reach =
        leaf_reach<true>(reaches + begin, std::min(per_leaf, count - begin), clip, steps, sum);
    low[leaf] = -reach.minus_low;
    high[leaf] = reach.high;
  }
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
HWY_INLINE size_t write_list(const ForestChunk& chunk, uint32_t lights, uint32_t first, uint32_t per_leaf,
                             TreeNode* nodes) {
  size_t count = 0;
  const uint32_t most = ML_TREE_MAX_LEAF_LIGHTS / per_leaf * per_leaf;
  for (uint32_t begin = 0; begin < lights; begin += most) {
    const uint32_t part = std::min(lights - begin, most);
    float low = infinity, high = -infinity;
    for (uint32_t leaf = begin / per_leaf; leaf * per_leaf < begin + part; ++leaf) {
      low = std::min(low, chunk.low[leaf]);
      high = std::max(high, chunk.high[leaf]);
    }
    nodes[count++] = {low, high, first + begin, packed(true, part, 1)};
  }
  return count;
}

// Bottom-up from the leaves' bounds, every level from the one below it; each node goes to its depth-first
// place. Returns the number of nodes.
HWY_INLINE size_t write_tree(ForestChunk& chunk, uint32_t lights, uint32_t first, uint32_t per_leaf,
                             bool trim, TreeNode* nodes) {
  const uint32_t used = (lights + per_leaf - 1) / per_leaf, leaves = std::bit_ceil(used);
  const auto height = static_cast<uint32_t>(std::countr_zero(leaves));
  assert(leaves <= ML_TREE_MAX_LEAVES);
  float *low = chunk.low.data(), *high = chunk.high.data();
  for (uint32_t leaf = 0; leaf < used; ++leaf) {
    const uint32_t begin = leaf * per_leaf, count = std::min(per_leaf, lights - begin);
    nodes[depth_first_place(height, height, leaf)] = {low[leaf], high[leaf], first + begin,
                                                      packed(true, count, 1)};
  }
  for (uint32_t leaf = used; leaf < leaves; ++leaf) {
    low[leaf] = infinity;
    high[leaf] = -infinity;
    nodes[depth_first_place(height, height, leaf)] = {infinity, -infinity, 0, packed(true, 0, 1)};
  }
  uint32_t lights_below = per_leaf;
  for (uint32_t level = height; level-- > 0;) {
    lights_below *= 2;
    const uint32_t skip = (2u << (height - level)) - 1;
    for (uint32_t index = 0; index < 1u << level; ++index) {
      low[index] = std::min(low[2 * index], low[2 * index + 1]);
      high[index] = std::max(high[2 * index], high[2 * index + 1]);
      const uint32_t begin = std::min(index * lights_below, lights);
      nodes[depth_first_place(height, level, index)] = {
          low[index], high[index], std::min(lights_below, lights - begin), packed(false, 0, skip)};
    }
  }
  return trim ? depth_first_place(height, height, used - 1) + 1 : 2 * leaves - 1;
}

void build_chunk(const FroxelLists& lists, const ForestSettings& settings,
                 std::span<const FroxelGrid::DepthRange> cell_depths, TreeCell* cells, ForestChunk& chunk) {
  const uint32_t columns = lists.grid().columns, tiles = lists.grid().tiles();
  const uint32_t* offsets = lists.offsets().data();
  const std::span<const uint32_t> entries = lists.entries();
  const DepthReach* reach_of_light = lists.reach_of_light().data();
  StepSum unused;
  size_t count = 0;
  chunk.list_cells = chunk.tree_cells = 0;
  // A row of froxels at a time, or the part of it that is the chunk's.
  for (uint32_t cell = chunk.first_cell; cell < chunk.end_cell;) {
    const uint32_t row_first = offsets[cell],
                   row_end = std::min(cell + columns - cell % columns, chunk.end_cell);
    const FroxelGrid::DepthRange extent = cell_depths[cell / tiles];
    const size_t row_lights = offsets[row_end] - row_first;
    uint32_t longest = 0;
    for (uint32_t c = cell; c < row_end; ++c) longest = std::max(longest, offsets[c + 1] - offsets[c]);
    // No depth matters where all cells are short lists.
    const uint32_t short_list = std::max(settings.lights_per_leaf, settings.list_lights);
    if (longest > short_list || settings.list_nodes) {
      reserve_padded(chunk.reaches, row_lights);
      collect(entries.subspan(row_first), row_lights, reach_of_light, chunk.reaches.data());
      // Room for full trees of twice the leaves, or the nodes of lists.
      const size_t leaves = row_lights / settings.lights_per_leaf + columns;
      reserve_padded(chunk.low, 2 * leaves);
      reserve_padded(chunk.high, 2 * leaves);
      reserve_padded(chunk.nodes, count + 4 * leaves);
    }
    const DepthReach* reaches = chunk.reaches.data();
    for (; cell < row_end; ++cell) {
      const uint32_t first = offsets[cell], lights = offsets[cell + 1] - first;
      TreeNode* nodes = chunk.nodes.data() + count;
      size_t written = 0;
      if (lights > short_list) {
        const uint32_t per_leaf = leaf_size(settings.lights_per_leaf, lights);
        const uint64_t sum = bound_leaves(chunk, reaches + (first - row_first), lights, per_leaf, extent);
        const bool tree = lights > per_leaf && is_tree(sum, lights, settings.threshold);
        if (tree)
          written = write_tree(chunk, lights, first, per_leaf, settings.trim_padding, nodes);
        else if (settings.list_nodes)
          written = write_list(chunk, lights, first, per_leaf, nodes);
        chunk.tree_cells += tree;
        chunk.list_cells += !tree;
      } else {
        chunk.list_cells += lights > 0;
        if (settings.list_nodes && lights > 0) {
          const DepthReach bounds = leaf_reach<false>(reaches + (first - row_first), lights, {}, 0, unused);
          *nodes = {-bounds.minus_low, bounds.high, first, packed(true, lights, 1)};
          written = 1;
        }
      }
      if (written > 0)
        cells[cell] = {static_cast<uint32_t>(count), static_cast<uint32_t>(count + written)};
      else
        cells[cell] = lights > 0 ? TreeCell{first, ML_TREE_CELL_LIST | lights} : TreeCell{0, 0};
      count += written;
    }
  }
  chunk.count = count;
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml::simd {

HWY_EXPORT(build_chunk);

void build_chunk(const FroxelLists& lists, const ForestSettings& settings,
                 std::span<const FroxelGrid::DepthRange> cell_depths, gpu_data::TreeCell* cells,
                 ForestChunk& chunk) {
  HWY_DYNAMIC_DISPATCH(build_chunk)(lists, settings, cell_depths, cells, chunk);
}

}  // namespace ml::simd
#endif
