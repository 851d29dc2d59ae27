// The froxel grid as shaders see it.
#ifndef ML_FROXELS_GRID_DATA_H
#define ML_FROXELS_GRID_DATA_H
#include "shaders/shared/slices.h"
ML_NAMESPACE_BEGIN

struct FroxelGridData {
  SliceMapping mapping;
  float inverse_tile;  // 1/px
  uint columns;        // tiles across the picture
  uint tiles;          // froxels of a slice
  uint narrow;         // not 0: light indices of lists have 16 bits, two in a word
};
ML_SIZE(FroxelGridData, 28);

// The tile of a pixel along one axis. The same as an integer division up to 2^21 px, which processors do not
// have for several numbers at once: the middle of a pixel is half a pixel or more away from an edge, and
// rounding takes less.
ML_FUNCTION uint tile_of_pixel(uint pixel, float inverse_tile) {
  ML_PRECISE float tile = (float(pixel) + 0.5f) * inverse_tile;
  return uint(tile);
}

ML_NAMESPACE_END
#endif
