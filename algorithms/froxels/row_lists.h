// Lists of a grid where lights cover dozens of froxels each, without writing down a pair for each light and
// froxel. A light's froxels are a box, so the lights of a slice are sifted out of all lights, those of each
// of its rows out of them, and those of each froxel out of its row's, many lights an instruction.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "algorithms/froxels/binning.h"

namespace ml {

// Memory of list_rows(), kept between frames. Lanes as narrow as light indices and extents allow.
class RowMemory {
 public:
  // First froxel and extent along each axis of some lights' boxes.
  template <typename Lane>
  struct Boxes {
    std::vector<Lane> light, column, columns, row, rows, slice, slices;
  };
  template <typename Lane>
  struct Levels {
    Boxes<Lane> all, slice, row;
    std::vector<Lane> list;
  };
  template <typename Lane>
  Levels<Lane>& levels() {
    return std::get<Levels<Lane>>(levels_);
  }

 private:
  std::tuple<Levels<uint8_t>, Levels<uint16_t>, Levels<uint32_t>> levels_;
};

namespace simd {
// How many lights are sifted at a time when no light's index reaches `light_end`.
uint32_t row_lanes(size_t light_end, const FroxelGrid& grid);
// Writes the lights of all froxels one after the other, each froxel's in the order of the boxes
// boxes[indices[0..count)], or without indices boxes[0..count), and offsets[0 .. cells]: where each froxel's
// begin, and the end of the last. `list` has space for all and is written from front to back. Returns the
// longest list.
uint32_t list_rows(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
                   size_t light_end, RowMemory& memory, uint32_t* offsets, uint32_t* list);
}  // namespace simd

// Whether list_rows() is cheaper than `pairs` pairs of a froxel and a light: a step of either costs about the
// same. boxes[0..count) in any order.
bool rows_are_cheaper(const LightBox* boxes, size_t count, uint64_t pairs, const FroxelGrid& grid,
                      size_t light_end);

}  // namespace ml
