// Compiled once for every instruction set; the best one is chosen at run time (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/froxels/dense_lists.cpp"
#include "algorithms/froxels/dense_lists.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint32_t, 16>;
using VU = hn::Vec<Words>;
constexpr Words du;

void mark(const LightBox* boxes, const uint32_t* places, size_t count, const FroxelGrid& grid,
          FroxelMasks& masks) {
  const size_t lanes = hn::Lanes(du);
  masks.stride = (grid.cells() + vector_padding) / vector_padding * vector_padding + vector_padding;
  masks.words.assign(masks.stride * ((count + 31) / 32), 0);
  reserve_padded(masks.lights, count);
  for (size_t i = 0; i < count; ++i) {
    const LightBox& box = boxes[places ? places[i] : i];
    masks.lights[i] = box.light;
    uint32_t* words = masks.words.data() + i / 32 * masks.stride + box.first;
    const VU bit = hn::Set(du, 1u << i % 32);
    for (uint32_t slice = 0; slice < box.slices; ++slice)
      for (uint32_t row = 0; row < box.rows; ++row) {
        uint32_t* run = words + grid.cell(0, row, slice);
        for (size_t column = 0; column < box.columns; column += lanes) {
          const VU marked = hn::IfThenElseZero(hn::FirstN(du, box.columns - column), bit);
          hn::StoreU(hn::Or(hn::LoadU(du, run + column), marked), du, run + column);
        }
      }
  }
}

void count_marks(const FroxelMasks& masks, uint32_t cells, uint32_t* counts) {
  for (size_t cell = 0; cell < cells; cell += hn::Lanes(du)) {
    VU sum = hn::Zero(du);
    for (const uint32_t* words = masks.words.data() + cell; words < masks.words.data() + masks.words.size();
         words += masks.stride)
      sum = hn::Add(sum, hn::PopulationCount(hn::LoadU(du, words)));
    hn::StoreU(sum, du, counts + cell);
  }
}

void list_marks(const FroxelMasks& masks, uint32_t cells, const uint32_t* offsets, uint32_t* list) {
  constexpr uint32_t lanes = static_cast<uint32_t>(hn::MaxLanes(du));
  constexpr uint32_t lane_bits = (uint64_t{1} << lanes) - 1;
  const size_t words = masks.words.size() / masks.stride;
  for (uint32_t cell = 0; cell < cells; ++cell) {
    uint32_t* to = list + offsets[cell];
    for (size_t word = 0; word < words; ++word) {
      uint32_t left = masks.words[word * masks.stride + cell];
      const uint32_t* lights = &masks.lights[word * 32];
      for (; left != 0; left = lanes < 32 ? left >> (lanes % 32) : 0, lights += lanes) {
        const uint64_t bits = left & lane_bits;
        uint8_t bytes[8];
        for (int i = 0; i < 8; ++i) bytes[i] = static_cast<uint8_t>(bits >> (8 * i));
        hn::StoreU(hn::Compress(hn::LoadU(du, lights), hn::LoadMaskBits(du, bytes)), du, to);
        to += std::popcount(bits);
      }
    }
  }
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml::simd {

HWY_EXPORT(mark);
HWY_EXPORT(count_marks);
HWY_EXPORT(list_marks);

void mark(const LightBox* boxes, const uint32_t* places, size_t count, const FroxelGrid& grid,
          FroxelMasks& masks) {
  HWY_DYNAMIC_DISPATCH(mark)(boxes, places, count, grid, masks);
}
void count_marks(const FroxelMasks& masks, uint32_t cells, uint32_t* counts) {
  HWY_DYNAMIC_DISPATCH(count_marks)(masks, cells, counts);
}
void list_marks(const FroxelMasks& masks, uint32_t cells, const uint32_t* offsets, uint32_t* list) {
  HWY_DYNAMIC_DISPATCH(list_marks)(masks, cells, offsets, list);
}

}  // namespace ml::simd
#endif
