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
  // View-space centre (m), widened radius (m), light index; vector padding after the last element.
  std::vector<float> x, y, z, radius;
  std::vector<uint32_t> index;
  size_t count = 0;  // elements in use, where they are one run from the first on
  void reserve(size_t lights);
};

// A run of visible lights. Vector code reads up to 64 elements past the last one.
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

// The froxel box of a visible light: all that is needed to write it into lists, in a quarter of a cache line.
struct LightBox {
  uint32_t first;          // number of its first froxel
  uint32_t light;          // index
  uint16_t columns, rows;  // extents in froxels; all 0 for an empty box
  uint32_t slices;
  uint64_t froxels() const { return uint64_t{columns} * rows * slices; }
};
static_assert(sizeof(LightBox) == 16);

// View depths (m) between which a light reaches surface points, widened by what rounding may take.
struct DepthInterval {
  float low, high;
};
// The same with the low end negated, so that vector code treats both ends alike.
struct DepthReach {
  float minus_low, high;
};

// Elements past the last one that vector code may touch, and the multiple at which runs begin that are
// written side by side.
inline constexpr size_t vector_padding = 64;

// Makes space for `count` elements and the padding; grows rarely and never shrinks.
template <typename Element>
void reserve_padded(std::vector<Element>& elements, size_t count) {
  if (elements.size() < count + vector_padding) elements.resize(count + count / 4 + vector_padding);
}

// (froxel, light) pairs in the order of lights.
struct FroxelPairs {
  std::vector<uint32_t> cell, light;
  // Where they were asked for: the depths that the light reaches in the froxel's tile, as DepthReach (m).
  std::vector<float> minus_low, high;
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
  uint32_t built_columns_ = 0, built_rows_ = 0;
  std::vector<uint32_t> table_;
};

namespace scalar {
// The exact 2D bounds of the clipped, projected ball (Mara & McGuire 2013) and its depth extent, as froxels;
// empty when no pixel centre of the picture can be inside. Ball in view space, already widened.
FroxelBox bound_ball(const BoundsConstants& constants, float x, float y, float z, float radius);
// See below; without reaches.
size_t cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
            VisibleLights& visible);
uint64_t bound(const VisibleRun& visible, const BoundsConstants& constants, LightBox* boxes);
// The depths of a ball, as cull() writes them.
DepthInterval depth_interval(float z, float radius);
}  // namespace scalar

namespace simd {
// Writes the visible ones of lights [begin, end) to `visible`, from its element `begin` on, and returns how
// many they are. With `reaches`, reaches[i] becomes light i's depths, visible or not. Both have space for all
// lights and the padding; whole vectors are written. Parts that begin at multiples of the padding can be
// culled side by side.
size_t cull(const FrameLights& lights, size_t begin, size_t end, const BoundsConstants& constants,
            VisibleLights& visible, DepthReach* reaches = nullptr);
// boxes[i]: of light i of the run; whole vectors are written. Returns the sum of the boxes' froxels.
uint64_t bound(const VisibleRun& visible, const BoundsConstants& constants, LightBox* boxes);
// Writes the pairs of the boxes boxes[indices[0..count)], or boxes[0..count) without indices, one after the
// other.
void emit(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
          const BoxOffsets& offsets, FroxelPairs& pairs);
}  // namespace simd

// Sum of the boxes' froxels, the pairs that emit() will write; indices as there. bound() returns that of a
// whole run.
uint64_t count_pairs(const LightBox* boxes, const uint32_t* indices, size_t count);
// Makes space for `count` pairs and the vector code's padding.
void reserve_pairs(FroxelPairs& pairs, size_t count, bool with_reaches = false);

}  // namespace ml
