// CPU stages of clustered binning. Culling and bounding have two forms that give the same bits: plain scalar
// code, the readable reference, and vector code (Highway), the one that runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/clustered/froxel_grid.h"

namespace ml {

// Lights in front of the camera and not outside a side plane of the view, in view space, in ascending order
// of index.
struct VisibleLights {
  // View-space centre (m), widened radius (m), light index; the first `count` elements are in use, vector
  // padding behind them.
  std::vector<float> x, y, z, radius;
  std::vector<uint32_t> index;
  size_t count = 0;
  void reserve(size_t lights);
};

// The froxel box of each visible light: number of its first froxel and extents, 0 extents for an empty box.
struct LightBoxes {
  std::vector<uint32_t> first, columns, rows, slices;
  void reserve(size_t lights);
};

// (froxel, light) pairs in the order of lights.
struct FroxelPairs {
  std::vector<uint32_t> froxel, light;
  size_t count = 0;
};

// Froxel numbers of a box relative to its first, for boxes of up to 4 x 4 x 4:
// [columns-1][rows-1][slices-1][64].
class BoxOffsets {
 public:
  static constexpr uint32_t max_extent = 4, stride = 64;
  void build(const FroxelGrid& grid);
  const uint32_t* get(uint32_t columns, uint32_t rows, uint32_t slices) const {
    return &table_[(((columns - 1) * max_extent + rows - 1) * max_extent + slices - 1) * stride];
  }

 private:
  uint32_t built_columns_ = 0, built_slices_ = 0;
  std::vector<uint32_t> table_;
};

namespace scalar {
// The exact 2D bounds of the clipped, projected ball (Mara & McGuire 2013) and its depth extent, as froxels;
// empty when no pixel centre of the picture can be inside. Ball in view space, already widened.
FroxelBox bound_ball(const BoundsConstants& constants, float x, float y, float z, float radius);
void cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
          VisibleLights& visible);
void bound(const VisibleLights& visible, const BoundsConstants& constants, LightBoxes& boxes);
}  // namespace scalar

namespace simd {
void cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
          VisibleLights& visible);
void bound(const VisibleLights& visible, const BoundsConstants& constants, LightBoxes& boxes);
void emit(const VisibleLights& visible, const LightBoxes& boxes, const FroxelGrid& grid,
          const BoxOffsets& offsets, FroxelPairs& pairs);
// The instruction set that is used on this machine, as Highway names it.
const char* target_name();
}  // namespace simd

// Sum of the boxes' froxels: the pairs that emit() will write.
uint64_t count_pairs(const LightBoxes& boxes, size_t lights);
// Makes room for `count` pairs and the vector code's padding.
void reserve_pairs(FroxelPairs& pairs, size_t count);

}  // namespace ml
