// Which pixels of a block of 8x8 the threads of a workgroup shade, and which of them are a subgroup.
#ifndef ML_SHARED_PIXEL_GROUPS_H
#define ML_SHARED_PIXEL_GROUPS_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

// Eight neighbouring threads are 4x2 pixels, 16 are 4x4, 32 are 8x4: nearly square, so that the pixels of a
// subgroup have much in common, whatever its size.
ML_FUNCTION uvec2 pixel_in_block(uint thread) {
  return uvec2((thread & 3u) | (thread >> 2 & 4u), (thread >> 2 & 3u) | (thread >> 3 & 4u));
}

// The other way round.
ML_FUNCTION uint thread_of_pixel(uvec2 pixel) {
  return (pixel.x & 3u) | (pixel.y & 3u) << 2 | (pixel.x & 4u) << 2 | (pixel.y & 4u) << 3;
}

// The pixels of a group that a subgroup of so many lanes (a power of two) shades.
ML_FUNCTION uint group_pixels(uint lanes) {
  return lanes < 64u ? lanes : 64u;
}

// The number of a pixel's group of `pixels` (group_pixels()), which are `pixels` neighbouring threads
// of a block: block by block, row by row, `blocks` in a row.
ML_FUNCTION uint group_of_pixel(uvec2 pixel, uint blocks, uint pixels) {
  uint block = (pixel.y >> 3) * blocks + (pixel.x >> 3);
  return (block * 64u + thread_of_pixel(uvec2(pixel.x & 7u, pixel.y & 7u))) / pixels;
}

ML_NAMESPACE_END
#endif
