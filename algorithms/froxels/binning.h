// CPU stages of binning lights into froxels. Culling and bounding have two forms that give the same bits:
// plain scalar code, the readable reference, and vector code (Highway), the one that runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/froxels/froxel_grid.h"

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

// A run of visible lights. Vector code reads up to 64 elements behind the last one.
struct VisibleRun {
  const float *x, *y, *z, *radius;
  const uint32_t* index;
  size_t count;
  VisibleRun(const VisibleLights& lights) : VisibleRun(lights, 0, lights.count) {}
  VisibleRun(const VisibleLights& lights, size_t begin, size_t end)
      : x(lights.x.data() + begin),
        y(lights.y.data() + begin),
        z(lights.z.data() + begin),
        radius(lights.radius.data() + begin),
        index(lights.index.data() + begin),
        count(end - begin) {}
};

// The froxel box of each visible light: number of its first froxel and extents, 0 extents for an empty box.
struct LightBoxes {
  std::vector<uint32_t> first, columns, rows, slices;
  void reserve(size_t lights);
};

// View depths (m) between which each visible light reaches surface points, widened by what rounding may take.
struct DepthRanges {
  std::vector<float> low, high;
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
void bound(const VisibleRun& visible, const BoundsConstants& constants, LightBoxes& boxes);
// The depth range of a ball, as written by depth_ranges().
struct DepthInterval {
  float low, high;
};
DepthInterval depth_interval(float z, float radius);
}  // namespace scalar

namespace simd {
void cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
          VisibleLights& visible);
void bound(const VisibleRun& visible, const BoundsConstants& constants, LightBoxes& boxes);
// low[i], high[i]: depth range of light i of the run; writes whole vectors.
void depth_ranges(const VisibleRun& visible, float* low, float* high);
void emit(const VisibleRun& visible, const LightBoxes& boxes, const FroxelGrid& grid,
          const BoxOffsets& offsets, FroxelPairs& pairs);
// to[i] = table[places[i]].
void gather(std::span<const uint32_t> table, std::span<const uint32_t> places, uint32_t* to);
// The instruction set that is used on this machine, as Highway names it.
const char* target_name();
}  // namespace simd

// Sum of the boxes' froxels: the pairs that emit() will write.
uint64_t count_pairs(const LightBoxes& boxes, size_t lights);
// Makes room for `count` pairs and the vector code's padding.
void reserve_pairs(FroxelPairs& pairs, size_t count);

}  // namespace ml
