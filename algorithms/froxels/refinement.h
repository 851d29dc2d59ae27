// Sphere refinement (Persson 2013): inside its box of froxels a ball misses the corners. For every row and
// slice of froxels that the box covers, the columns are narrowed to those that the ball's part between the
// row's and the slice's planes can reach.
#pragma once

#include "algorithms/froxels/binning.h"

namespace ml {

// What is constant over a frame: the planes between rows and the depths between slices.
struct RefinementPlanes {
  std::vector<FroxelGrid::DepthRange> slices;
  // Window coordinate (slope or metres) of the lower and upper edge of each row's pixel centres, widened.
  std::vector<float> row_low, row_high;
  void build(const BoundsConstants& constants);
};

// Writes the pairs of boxes, narrowed; never leaves out a froxel that holds a pixel centre's ray inside the
// ball. The boxes and their lights are those at indices[0..count), or without indices at [first, first +
// count).
void emit_refined(const VisibleLights& visible, const LightBox* boxes, const uint32_t* indices, size_t first,
                  size_t count, const BoundsConstants& constants, const RefinementPlanes& planes,
                  FroxelPairs& pairs);

}  // namespace ml
