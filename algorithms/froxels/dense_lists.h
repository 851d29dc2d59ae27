// Lists of a grid where few lights cover many froxels each: a bit for every light and froxel instead of a
// pair. Marking a row of froxels is one instruction for as many of them as a register holds, and lists are
// read off the bits.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/froxels/binning.h"

namespace ml {

// A bit for each froxel and each light: bit i % 32 of words[i / 32 * stride + froxel] is the i-th light's.
struct FroxelMasks {
  std::vector<uint32_t> words;
  size_t stride = 0;             // froxels and the vector padding
  std::vector<uint32_t> lights;  // what stands in lists for each bit
};

// Whether bits are the cheaper way: they cost about half a pair for each froxel and 16 lights.
inline bool dense(uint64_t pairs, uint32_t cells, size_t lights) {
  return 2 * pairs > uint64_t{cells} * ((lights + 15) / 16);
}

namespace simd {
// Marks boxes[places[0..count)], or without places boxes[0..count).
void mark(const LightBox* boxes, const uint32_t* places, size_t count, const FroxelGrid& grid,
          FroxelMasks& masks);
// counts[froxel]: how many bits it has; whole vectors are written.
void count_marks(const FroxelMasks& masks, uint32_t cells, uint32_t* counts);
// Writes the lights of each froxel to list[offsets[froxel]...], in the order of bits; whole vectors are
// written.
void list_marks(const FroxelMasks& masks, uint32_t cells, const uint32_t* offsets, uint32_t* list);
}  // namespace simd

}  // namespace ml
