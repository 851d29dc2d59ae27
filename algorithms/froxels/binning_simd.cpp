// The vector form of the binning stages: the same operations in the same order as binning_scalar.cpp, so the
// same bits, on as many lights at once as the machine's registers hold. Compiled once for every instruction
// set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/froxels/binning_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>

#include "algorithms/froxels/binning.h"
#include "algorithms/froxels/kept_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using Signed = hn::RebindToSigned<Floats>;
using VF = hn::Vec<Floats>;
using VU = hn::Vec<Words>;
using MF = hn::Mask<Floats>;

constexpr Floats df;
constexpr Words du;
constexpr Signed ds;

HWY_INLINE VF constant(float value) {
  return hn::Set(df, value);
}

// Same as gpu_data::slice_log2.
HWY_INLINE VF slice_log2(VF z) {
  VU shifted = hn::Add(hn::BitCast(du, z), hn::Set(du, 0x3f800000u - 0x3f3504f3u));
  VF exponent = hn::ConvertTo(df, hn::Sub(hn::BitCast(ds, hn::ShiftRight<23>(shifted)), hn::Set(ds, 127)));
  VU mantissa = hn::Add(hn::And(shifted, hn::Set(du, 0x007fffffu)), hn::Set(du, 0x3f3504f3u));
  VF x = hn::Sub(hn::BitCast(df, mantissa), constant(1.0f));
  VF p = constant(0.123109683f);
  for (float coefficient : {-0.205861881f, 0.216078222f, -0.239169881f, 0.287903249f, -0.360693276f,
                            0.480910748f, -0.721347451f, 1.44269502f})
    p = hn::Add(hn::Mul(p, x), constant(coefficient));
  return hn::Add(exponent, hn::Mul(p, x));
}

// Same as gpu_data::slice_of_depth.
HWY_INLINE VU slice_of_depth(VF z, const gpu_data::SliceMapping& mapping) {
  MF positive = hn::Gt(z, constant(1e-30f));
  VF slice = hn::Add(hn::Mul(hn::Sub(slice_log2(z), constant(mapping.log_min)), constant(mapping.scale)),
                     constant(1.0f));
  slice = hn::IfThenElseZero(hn::And(positive, hn::Gt(slice, hn::Zero(df))), slice);
  slice = hn::Min(slice, constant(static_cast<float>(mapping.count - 1)));
  return hn::BitCast(du, hn::ConvertTo(ds, slice));
}

size_t cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& c,
            VisibleLights& visible, DepthReach* reaches) {
  const gpu_data::ViewData& v = c.view;
  const bool orthographic = v.orthographic != 0;
  auto plane_length = [&](float edge) { return orthographic ? 1.0f : std::sqrt(1.0f + edge * edge); };
  const VF left_length = constant(plane_length(v.left_edge)),
           right_length = constant(plane_length(v.right_edge));
  const VF bottom_length = constant(plane_length(v.bottom_edge)),
           top_length = constant(plane_length(v.top_edge));
  const size_t lanes = hn::Lanes(df);
  size_t next = begin;
  for (size_t i = begin; i < end; i += lanes) {
    VF wx = hn::LoadU(df, &lights.x[0] + i), wy = hn::LoadU(df, &lights.y[0] + i),
       wz = hn::LoadU(df, &lights.z[0] + i);
    auto along = [&](const glm::vec3& axis) {
      return hn::Add(hn::Add(hn::Mul(wx, constant(axis.x)), hn::Mul(wy, constant(axis.y))),
                     hn::Mul(wz, constant(axis.z)));
    };
    VF x = along(v.right), y = along(v.up), z = along(v.forward);
    VF radius =
        hn::Add(hn::Mul(hn::LoadU(df, &lights.radius[0] + i), constant(widen_relative)),
                hn::Mul(constant(widen_absolute), hn::Add(hn::Add(hn::Abs(wx), hn::Abs(wy)), hn::Abs(wz))));
    if (reaches)
      hn::StoreInterleaved2(hn::Neg(hn::Mul(hn::Sub(z, radius), constant(0.99999f))),
                            hn::Mul(hn::Add(z, radius), constant(1.00001f)), df, &reaches[i].minus_low);
    VF minus_radius = hn::Neg(radius);
    auto distance = [&](VF p, float edge) {
      return hn::Sub(p, orthographic ? constant(edge) : hn::Mul(constant(edge), z));
    };
    MF out = hn::Lt(hn::Add(z, radius), constant(v.near));
    if (orthographic) out = hn::Or(out, hn::Gt(hn::Sub(z, radius), constant(v.far)));
    out = hn::Or(out, hn::Lt(distance(x, v.left_edge), hn::Mul(minus_radius, left_length)));
    out = hn::Or(out, hn::Lt(hn::Neg(distance(x, v.right_edge)), hn::Mul(minus_radius, right_length)));
    out = hn::Or(out, hn::Lt(distance(y, v.bottom_edge), hn::Mul(minus_radius, bottom_length)));
    out = hn::Or(out, hn::Lt(hn::Neg(distance(y, v.top_edge)), hn::Mul(minus_radius, top_length)));
    MF keep = hn::AndNot(out, hn::FirstN(df, end - i));
    const KeptLanes<Floats> kept(df, keep);
    kept.store(x, &visible.x[next]);
    kept.store(y, &visible.y[next]);
    kept.store(z, &visible.z[next]);
    kept.store(radius, &visible.radius[next]);
    kept.store(hn::Iota(du, static_cast<uint32_t>(i)), &visible.index[next]);
    next += kept.count();
  }
  return next - begin;
}

struct Interval {
  VF low, high;
};

HWY_INLINE Interval perspective_interval(VF a, VF z, VF radius, VF near) {
  const VF zero = hn::Zero(df);
  VF radius2 = hn::Mul(radius, radius);
  VF distance2 = hn::Add(hn::Mul(a, a), hn::Mul(z, z));
  VF tangent2 = hn::Sub(distance2, radius2);
  MF outside = hn::Gt(tangent2, zero);
  VF tangent = hn::Sqrt(hn::IfThenElseZero(outside, tangent2));
  VF a_tangent = hn::Mul(a, tangent), z_radius = hn::Mul(z, radius);
  VF z_tangent = hn::Mul(z, tangent), a_radius = hn::Mul(a, radius);
  VF high_a = hn::Add(a_tangent, z_radius), high_z = hn::Sub(z_tangent, a_radius);
  VF low_a = hn::Sub(a_tangent, z_radius), low_z = hn::Add(z_tangent, a_radius);
  VF limit = hn::Mul(near, distance2);
  MF high_seen = hn::And(outside, hn::Ge(hn::Mul(high_z, tangent), limit));
  MF low_seen = hn::And(outside, hn::Ge(hn::Mul(low_z, tangent), limit));
  // Few balls reach to the near plane, and many vectors hold none of them.
  if (hn::AllTrue(df, hn::And(low_seen, high_seen))) return {hn::Div(low_a, low_z), hn::Div(high_a, high_z)};
  VF behind = hn::Sub(z, near);
  VF chord2 = hn::Sub(radius2, hn::Mul(behind, behind));
  VF chord = hn::Sqrt(hn::IfThenElseZero(hn::Gt(chord2, zero), chord2));
  // One division a side: numerator and denominator are chosen first.
  VF low = hn::Div(hn::IfThenElse(low_seen, low_a, hn::Sub(a, chord)), hn::IfThenElse(low_seen, low_z, near));
  VF high =
      hn::Div(hn::IfThenElse(high_seen, high_a, hn::Add(a, chord)), hn::IfThenElse(high_seen, high_z, near));
  return {low, high};
}

// No box has more froxels than the grid, whose number is one of 32 bits; their sum may.
class FroxelSum {
 public:
#if HWY_TARGET == HWY_SCALAR
  void add(VU each) {
    sum_ += hn::GetLane(each);
  }
  uint64_t total() const {
    return sum_;
  }

 private:
  uint64_t sum_ = 0;
#else
  HWY_INLINE FroxelSum() : sum_(hn::Zero(Doubled())) {}
  HWY_INLINE void add(VU each) {
    const auto pairs = hn::BitCast(Doubled(), each);
    const auto even = hn::And(pairs, hn::Set(Doubled(), 0xffffffffu));
    sum_ = hn::Add(sum_, hn::Add(even, hn::ShiftRight<32>(pairs)));
  }
  HWY_INLINE uint64_t total() const {
    return hn::GetLane(hn::SumOfLanes(Doubled(), sum_));
  }

 private:
  using Doubled = hn::Repartition<uint64_t, Words>;
  hn::Vec<Doubled> sum_;
#endif
};

template <bool orthographic>
uint64_t bound_all(const VisibleRun& visible, const BoundsConstants& c, LightBox* boxes) {
  const size_t lanes = hn::Lanes(df);
  const VF near = constant(c.view.near), half_tile = constant(0.5f), inverse_tile = constant(c.inverse_tile);
  const VF before = constant(0.5f + widen_pixels), after = constant(0.5f - widen_pixels);
  FroxelSum froxels;
  const VU columns = hn::Set(du, c.grid.columns), rows = hn::Set(du, c.grid.rows), one = hn::Set(du, 1);
  for (size_t i = 0; i < visible.count; i += lanes) {
    VF x = hn::LoadU(df, visible.x + i), y = hn::LoadU(df, visible.y + i), z = hn::LoadU(df, visible.z + i);
    VF radius = hn::LoadU(df, visible.radius + i);
    Interval across, up;
    if constexpr (orthographic) {
      across = {hn::Sub(x, radius), hn::Add(x, radius)};
      up = {hn::Sub(y, radius), hn::Add(y, radius)};
    } else {
      across = perspective_interval(x, z, radius, near);
      up = perspective_interval(y, z, radius, near);
    }
    auto pixel = [&](VF window, float edge, float scale) {
      return hn::Mul(hn::Sub(window, constant(edge)), constant(scale));
    };
    VF column0 = hn::Ceil(hn::Sub(pixel(across.low, c.left_edge, c.x_pixels_per_unit), before));
    VF column1 = hn::Floor(hn::Sub(pixel(across.high, c.left_edge, c.x_pixels_per_unit), after));
    VF row0 = hn::Ceil(hn::Sub(pixel(up.high, c.top_edge, c.y_pixels_per_unit), before));
    VF row1 = hn::Floor(hn::Sub(pixel(up.low, c.top_edge, c.y_pixels_per_unit), after));
    column0 = hn::Max(column0, hn::Zero(df));
    row0 = hn::Max(row0, hn::Zero(df));
    column1 = hn::Min(column1, constant(c.last_column_pixel));
    row1 = hn::Min(row1, constant(c.last_row_pixel));
    MF kept = hn::And(hn::Le(column0, column1), hn::Le(row0, row1));
    auto tile = [&](VF p) {
      return hn::BitCast(
          du, hn::ConvertTo(ds, hn::IfThenElseZero(kept, hn::Mul(hn::Add(p, half_tile), inverse_tile))));
    };
    VU x0 = tile(column0), x1 = tile(column1), y0 = tile(row0), y1 = tile(row1);
    VU z0 = slice_of_depth(hn::Mul(hn::Sub(z, radius), constant(0.99999f)), c.grid.mapping);
    VU z1 = slice_of_depth(hn::Mul(hn::Add(z, radius), constant(1.00001f)), c.grid.mapping);
    auto kept_words = hn::RebindMask(du, kept);
    VU first = hn::Add(hn::Mul(hn::Add(hn::Mul(z0, rows), y0), columns), x0);
    VU wide = hn::Add(hn::Sub(x1, x0), one), high = hn::Add(hn::Sub(y1, y0), one);
    VU deep = hn::IfThenElseZero(kept_words, hn::Add(hn::Sub(z1, z0), one));
    hn::StoreInterleaved4(hn::IfThenElseZero(kept_words, first), hn::LoadU(du, visible.index + i),
                          hn::IfThenElseZero(kept_words, hn::Or(wide, hn::ShiftLeft<16>(high))), deep, du,
                          &boxes[i].first);
    const VU each = hn::IfThenElseZero(hn::FirstN(du, visible.count - i), hn::Mul(hn::Mul(wide, high), deep));
    froxels.add(each);
  }
  return froxels.total();
}

uint64_t bound(const VisibleRun& visible, const BoundsConstants& c, LightBox* boxes) {
  return c.view.orthographic ? bound_all<true>(visible, c, boxes) : bound_all<false>(visible, c, boxes);
}

template <bool ordered>
void emit_all(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
              const BoxOffsets& offsets, FroxelPairs& pairs) {
  // Most boxes have four froxels or fewer: wider vectors would write more in vain.
  constexpr hn::CappedTag<uint32_t, 8> de;
  using VE = hn::Vec<hn::CappedTag<uint32_t, 8>>;
  // Indices jump about in more memory than the nearest caches hold, and are known long before.
  constexpr size_t ahead = 24;
  const size_t lanes = hn::Lanes(de);
  uint32_t* cell = pairs.cell.data();
  uint32_t* light = pairs.light.data();
  for (size_t i = 0; i < count; ++i) {
    if (ordered) hwy::Prefetch(&boxes[indices[i + ahead]]);
    const LightBox& box = boxes[ordered ? indices[i] : i];
    const uint32_t columns = box.columns, rows = box.rows, slices = box.slices;
    const uint32_t total = columns * rows * slices;
    if (total == 0) continue;
    const VE first = hn::Set(de, box.first), index = hn::Set(de, box.light);
    constexpr uint32_t max_extent = BoxOffsets::max_extent;
    if ((columns <= max_extent) & (rows <= max_extent) & (slices <= max_extent)) {
      // Whole vectors are written; what is too much is overwritten by the next light.
      const uint32_t* table = offsets.get(columns, rows, slices);
      size_t k = 0;
      do {
        hn::StoreU(hn::Add(first, hn::LoadU(de, table + k)), de, cell + k);
        hn::StoreU(index, de, light + k);
        k += lanes;
      } while (k < total);
      cell += total;
      light += total;
    } else {
      for (uint32_t slice = 0; slice < slices; ++slice)
        for (uint32_t row = 0; row < rows; ++row) {
          VE run = hn::Add(first, hn::Iota(de, grid.cell(0, row, slice)));
          size_t k = 0;
          do {
            hn::StoreU(run, de, cell + k);
            hn::StoreU(index, de, light + k);
            run = hn::Add(run, hn::Set(de, static_cast<uint32_t>(lanes)));
            k += lanes;
          } while (k < columns);
          cell += columns;
          light += columns;
        }
    }
  }
  pairs.count = static_cast<size_t>(cell - pairs.cell.data());
}

void emit(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
          const BoxOffsets& offsets, FroxelPairs& pairs) {
  if (indices)
    emit_all<true>(boxes, indices, count, grid, offsets, pairs);
  else
    emit_all<false>(boxes, nullptr, count, grid, offsets, pairs);
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml::simd {

HWY_EXPORT(cull);
HWY_EXPORT(bound);
HWY_EXPORT(emit);

size_t cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
            VisibleLights& visible, DepthReach* reaches) {
  return HWY_DYNAMIC_DISPATCH(cull)(lights, begin, end, constants, visible, reaches);
}
uint64_t bound(const VisibleRun& visible, const BoundsConstants& constants, LightBox* boxes) {
  return HWY_DYNAMIC_DISPATCH(bound)(visible, constants, boxes);
}
void emit(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
          const BoxOffsets& offsets, FroxelPairs& pairs) {
  HWY_DYNAMIC_DISPATCH(emit)(boxes, indices, count, grid, offsets, pairs);
}

}  // namespace ml::simd
#endif
