// The vector form of the ball test: the same operations in the same order as ball_test.cpp, so the same bits,
// on as many of a light's froxels at once as lanes. Compiled once for every instruction set (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/froxels/ball_test_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "algorithms/froxels/ball_test.h"
#include "algorithms/froxels/kept_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Most boxes have eight froxels or fewer.
using Floats = hn::CappedTag<float, 8>;
using Words = hn::RebindToUnsigned<Floats>;
using VF = hn::Vec<Floats>;
using VU = hn::Vec<Words>;
using MF = hn::Mask<Floats>;
constexpr Floats df;
constexpr Words du;

struct Ball {
  VF x, y, z, radius2;
};
// The froxels of the lanes.
struct Edges {
  VF left, right, bottom, top, near, far;
};

struct Side {
  VF edge, away;
};
HWY_INLINE Side nearest_side(VF at, VF low, VF high, VF scale) {
  const VF below = hn::Sub(hn::Mul(low, scale), at), above = hn::Sub(hn::Mul(high, scale), at);
  const MF is_below = hn::Gt(below, hn::Zero(df)), is_above = hn::Lt(above, hn::Zero(df));
  return {hn::IfThenElse(is_below, low, hn::IfThenElseZero(is_above, high)),
          hn::IfThenElse(is_below, below, hn::IfThenElseZero(is_above, above))};
}

HWY_INLINE VF clamped(VF value, VF low, VF high) {
  return hn::Min(hn::Max(value, low), high);
}

struct InFroxels {
  MF reached;
  VF minus_low, high;  // m; computed only where they are asked for
};

template <bool orthographic, bool with_depths>
HWY_INLINE InFroxels ball_in_froxels(const Ball& ball, const Edges& e) {
  const VF one = hn::Set(df, 1);
  VF depth = clamped(ball.z, e.near, e.far);
  Side across, up;
  if constexpr (orthographic) {
    across = nearest_side(ball.x, e.left, e.right, one);
    up = nearest_side(ball.y, e.bottom, e.top, one);
    across.edge = up.edge = hn::Zero(df);
  } else {
    across = nearest_side(ball.x, e.left, e.right, depth);
    up = nearest_side(ball.y, e.bottom, e.top, depth);
    const VF sum = hn::Add(hn::Add(ball.z, hn::Mul(across.edge, ball.x)), hn::Mul(up.edge, ball.y));
    const VF squares = hn::Add(hn::Add(one, hn::Mul(across.edge, across.edge)), hn::Mul(up.edge, up.edge));
    depth = clamped(hn::Div(sum, squares), e.near, e.far);
    across = nearest_side(ball.x, e.left, e.right, depth);
    up = nearest_side(ball.y, e.bottom, e.top, depth);
  }
  const VF ahead = hn::Sub(depth, ball.z);
  const VF distance2 =
      hn::Add(hn::Add(hn::Mul(ahead, ahead), hn::Mul(across.away, across.away)), hn::Mul(up.away, up.away));
  const VF half_slope = hn::Add(hn::Add(ahead, hn::Mul(across.edge, across.away)), hn::Mul(up.edge, up.away));
  const VF step = clamped(hn::Sub(hn::Zero(df), half_slope), hn::Sub(e.near, depth), hn::Sub(e.far, depth));
  const VF least = hn::Add(distance2, hn::Mul(step, hn::Add(hn::Add(half_slope, half_slope), step)));
  InFroxels in{hn::Not(hn::Gt(least, ball.radius2)), hn::Zero(df), hn::Zero(df)};
  if constexpr (with_depths) {
    const VF squares = hn::Add(hn::Mul(half_slope, half_slope), ball.radius2);
    const VF under = hn::Add(hn::Sub(squares, distance2), hn::Mul(squares, hn::Set(df, chord_slack)));
    const VF half = hn::Sqrt(hn::Max(under, hn::Zero(df)));
    const VF middle = hn::Sub(depth, half_slope);
    in.minus_low = hn::Mul(hn::Sub(half, middle), hn::Set(df, 0.99999f));
    in.high = hn::Mul(hn::Add(half, middle), hn::Set(df, 1.00001f));
  }
  return in;
}

// from[which], which < 4.
HWY_INLINE VF pick(const float* from, VU which) {
#if HWY_TARGET == HWY_SCALAR
  return hn::LoadU(df, from + hn::GetLane(which));
#else
  return hn::TableLookupLanes(hn::LoadU(df, from), hn::IndicesFromVec(df, which));
#endif
}

template <bool orthographic, bool with_depths>
class Emitter {
 public:
  Emitter(const BallTest& test, const BoxOffsets& offsets, const FroxelGrid& grid, const DepthReach* reaches,
          FroxelPairs& pairs)
      : test_(test),
        offsets_(offsets),
        grid_(grid),
        reaches_(reaches),
        cell_(pairs.cell.data()),
        light_(pairs.light.data()),
        minus_low_(pairs.minus_low.data()),
        high_(pairs.high.data()) {}

  // All froxels of a box.
  HWY_INLINE void whole(const LightBox& box) {
    const DepthReach reach = with_depths ? reaches_[box.light] : DepthReach{};
    for (uint32_t slice = 0; slice < box.slices; ++slice)
      for (uint32_t row = 0; row < box.rows; ++row) {
        VU run = hn::Iota(du, box.first + grid_.cell(0, row, slice));
        for (uint32_t column = 0; column < box.columns; column += lanes()) {
          hn::StoreU(run, du, cell_ + column);
          hn::StoreU(hn::Set(du, box.light), du, light_ + column);
          if constexpr (with_depths) {
            hn::StoreU(hn::Set(df, reach.minus_low), df, minus_low_ + column);
            hn::StoreU(hn::Set(df, reach.high), df, high_ + column);
          }
          run = hn::Add(run, hn::Set(du, lanes()));
        }
        advance(box.columns);
      }
  }
  // Those of a box of up to 4 x 4 x 4 that the ball reaches.
  HWY_INLINE void small(const LightBox& box, const Ball& ball) {
    const uint32_t total = uint32_t{box.columns} * box.rows * box.slices;
    const Corner at = corner(box);
    const uint32_t* table = offsets_.get(box.columns, box.rows, box.slices);
    const uint32_t* coordinates = test_.box_coordinates(box.columns, box.rows, box.slices);
    const VU byte = hn::Set(du, 0xff);
    for (uint32_t k = 0; k < total; k += lanes()) {
      const VU in_box = hn::LoadU(du, coordinates + k);
      const VU column = hn::And(in_box, byte), row = hn::And(hn::ShiftRight<8>(in_box), byte),
               slice = hn::ShiftRight<16>(in_box);
      const Edges edges{
          pick(&test_.column_low[at.column], column), pick(&test_.column_high[at.column], column),
          pick(&test_.row_low[at.row], row),          pick(&test_.row_high[at.row], row),
          pick(&test_.slice_low[at.slice], slice),    pick(&test_.slice_high[at.slice], slice)};
      write(box, hn::Add(hn::Set(du, box.first), hn::LoadU(du, table + k)), ball, edges,
            hn::FirstN(df, total - k));
    }
  }
  HWY_INLINE void large(const LightBox& box, const Ball& ball) {
    const Corner at = corner(box);
    for (uint32_t slice = 0; slice < box.slices; ++slice)
      for (uint32_t row = 0; row < box.rows; ++row) {
        const uint32_t first = box.first + grid_.cell(0, row, slice);
        Edges edges;
        edges.bottom = hn::Set(df, test_.row_low[at.row + row]);
        edges.top = hn::Set(df, test_.row_high[at.row + row]);
        edges.near = hn::Set(df, test_.slice_low[at.slice + slice]);
        edges.far = hn::Set(df, test_.slice_high[at.slice + slice]);
        for (uint32_t column = 0; column < box.columns; column += lanes()) {
          edges.left = hn::LoadU(df, &test_.column_low[at.column + column]);
          edges.right = hn::LoadU(df, &test_.column_high[at.column + column]);
          write(box, hn::Iota(du, first + column), ball, edges, hn::FirstN(df, box.columns - column));
        }
      }
  }
  size_t written(const FroxelPairs& pairs) const { return static_cast<size_t>(cell_ - pairs.cell.data()); }

 private:
  struct Corner {
    uint32_t column, row, slice;
  };
  static uint32_t lanes() { return static_cast<uint32_t>(hn::Lanes(df)); }
  Corner corner(const LightBox& box) const {
    const uint32_t row = box.first / grid_.columns;
    const uint32_t slice = row / grid_.rows;
    return {box.first - row * grid_.columns, row - slice * grid_.rows, slice};
  }
  HWY_INLINE void write(const LightBox& box, VU cells, const Ball& ball, const Edges& edges, MF of_box) {
    const InFroxels in = ball_in_froxels<orthographic, with_depths>(ball, edges);
    const KeptLanes<Floats> kept(df, hn::And(in.reached, of_box));
    kept.store(cells, cell_);
    hn::StoreU(hn::Set(du, box.light), du, light_);
    if constexpr (with_depths) {
      const DepthReach whole = reaches_[box.light];
      kept.store(hn::Min(in.minus_low, hn::Set(df, whole.minus_low)), minus_low_);
      kept.store(hn::Min(in.high, hn::Set(df, whole.high)), high_);
    }
    advance(kept.count());
  }
  HWY_INLINE void advance(size_t pairs) {
    cell_ += pairs;
    light_ += pairs;
    if constexpr (with_depths) {
      minus_low_ += pairs;
      high_ += pairs;
    }
  }

  const BallTest& test_;
  const BoxOffsets& offsets_;
  const FroxelGrid& grid_;
  const DepthReach* reaches_;
  uint32_t *cell_, *light_;
  float *minus_low_, *high_;
};

template <bool orthographic, bool with_depths>
void emit_all(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
              size_t count, const FroxelGrid& grid, const BallTest& test, const BoxOffsets& offsets,
              const DepthReach* reaches, FroxelPairs& pairs) {
  // Indices jump about in more memory than the nearest caches hold, and are known long before.
  constexpr size_t ahead = 24;
  constexpr uint32_t max_extent = BoxOffsets::max_extent;
  Emitter<orthographic, with_depths> emitter(test, offsets, grid, reaches, pairs);
  for (size_t k = 0; k < count; ++k) {
    if (indices) {
      const size_t later = indices[k + ahead];
      hwy::Prefetch(&boxes[later]);
      hwy::Prefetch(&visible.x[later]);
      hwy::Prefetch(&visible.y[later]);
      hwy::Prefetch(&visible.z[later]);
      hwy::Prefetch(&visible.radius[later]);
      if constexpr (with_depths) hwy::Prefetch(&reaches[boxes[indices[k + ahead / 2]].light]);
    }
    const size_t i = indices ? indices[k] : first + k;
    const LightBox& box = boxes[i];
    if (!has_corners(box)) {
      emitter.whole(box);
      continue;
    }
    const VF radius = hn::Set(df, visible.radius[i]);
    const Ball ball{hn::Set(df, visible.x[i]), hn::Set(df, visible.y[i]), hn::Set(df, visible.z[i]),
                    hn::Mul(radius, radius)};
    if ((box.columns <= max_extent) & (box.rows <= max_extent) & (box.slices <= max_extent))
      emitter.small(box, ball);
    else
      emitter.large(box, ball);
  }
  pairs.count = emitter.written(pairs);
}

void emit_tested(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                 size_t count, const BoundsConstants& c, const BallTest& test, const BoxOffsets& offsets,
                 const DepthReach* reaches, FroxelPairs& pairs) {
  const auto emit = c.view.orthographic ? (reaches ? emit_all<true, true> : emit_all<true, false>)
                                        : (reaches ? emit_all<false, true> : emit_all<false, false>);
  emit(visible, boxes, indices, first, count, c.grid, test, offsets, reaches, pairs);
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml::simd {

HWY_EXPORT(emit_tested);

void emit_tested(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                 size_t count, const BoundsConstants& constants, const BallTest& test,
                 const BoxOffsets& offsets, const DepthReach* reaches, FroxelPairs& pairs) {
  HWY_DYNAMIC_DISPATCH(emit_tested)
  (visible, boxes, indices, first, count, constants, test, offsets, reaches, pairs);
}

}  // namespace ml::simd
#endif
