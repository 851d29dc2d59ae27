// Shared by the passes that find which lights contribute to which pixel.
#ifndef ML_SHARED_CONTRIBUTING_H
#define ML_SHARED_CONTRIBUTING_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

#define ML_BLOCK 8u  // px: a block's lights are found from the bounds of its surface points
#define ML_GROUP 8u  // blocks: a group of 8x8 blocks is tested against all lights first

// Bounds of the surface points of one block, camera-relative; empty (low > high) when all is sky.
struct BlockBounds {
  vec3 low, high;  // m
};
ML_SIZE(BlockBounds, 24);

struct ContributingPush {
  uvec2 blocks;     // blocks across and down
  uint mask_words;  // words of 32 lights in a group's mask
  // Words that a dispatch of contributing_pixels.comp looks at; what it finds is added to what those before
  // found.
  uint first_word, end_word;
};
ML_SIZE(ContributingPush, 20);

ML_NAMESPACE_END
#endif
