// Lanes that a mask keeps, moved to the front of vectors. Included once for every instruction set (Highway);
// AVX-512 has an instruction for it. Below it Highway's own Compress, as GCC compiles it, copies its table of
// 1 KiB to the stack on every call: here lanes are permuted by tables that stand in memory once.
#if defined(ML_KEPT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ML_KEPT_LANES_INL_H
#undef ML_KEPT_LANES_INL_H
#else
#define ML_KEPT_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "algorithms/froxels/compress_tables.h"

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
// Lanes of four bytes, four or eight of them.
template <class D>
class KeptLanes {
 public:
  HWY_INLINE KeptLanes(D d, hn::Mask<D> mask) {
    static_assert(sizeof(hn::TFromD<D>) == 4);
    // Eight bytes are written whatever the number of lanes.
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    bits_ = bits[0];
    const hn::RebindToUnsigned<D> du;
    if constexpr (eight)
      order_ = hn::PromoteTo(du, hn::LoadU(hn::Rebind<uint8_t, D>(), kept_of_eight[bits_].data()));
    else
      order_ = hn::BitCast(du, hn::Load(hn::Repartition<uint8_t, D>(), kept_bytes_of_four[bits_].data()));
  }
  size_t count() const { return hwy::PopCount(uint64_t{bits_}); }
  // Vectors of lanes of four bytes. Stores a whole vector, the kept lanes first.
  template <class T>
  HWY_INLINE void store(hn::Vec<hn::Rebind<T, D>> v, T* to) const {
    const hn::Rebind<T, D> d;
    const hn::RebindToUnsigned<D> du;
    if constexpr (eight)
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, order_)), d, to);
    else
      hn::StoreU(hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(du, v), order_)), d, to);
  }

 private:
  static constexpr bool eight = hn::MaxLanes(D()) == 8;
  uint32_t bits_;
  hn::Vec<hn::RebindToUnsigned<D>> order_;
};
#else
template <class D>
class KeptLanes {
 public:
  HWY_INLINE KeptLanes(D d, hn::Mask<D> mask) : mask_(mask), count_(hn::CountTrue(d, mask)) {}
  size_t count() const { return count_; }
  // Compressed in a register and stored whole: storing through a mask is microcoded, tens of times slower, on
  // some processors.
  template <class T>
  HWY_INLINE void store(hn::Vec<hn::Rebind<T, D>> v, T* to) const {
    const hn::Rebind<T, D> d;
    hn::StoreU(hn::Compress(v, hn::RebindMask(d, mask_)), d, to);
  }

 private:
  hn::Mask<D> mask_;
  size_t count_;
};
#endif

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
