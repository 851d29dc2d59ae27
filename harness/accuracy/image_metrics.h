// How different two pictures are.
#pragma once

#include <cstdint>

#include "harness/output/picture.h"

namespace ml {

struct ImageDifference {
  double max_relative = 0;            // largest per-channel |a-b| / max(|b|, floor) over pixels
  uint32_t worst_x = 0, worst_y = 0;  // its pixel, the first one row by row
  double rel_mse = 0;                 // mean over pixels and channels of (a-b)^2 / (b^2 + 1e-2 * mean(b)^2)
  double rmse = 0;
  // Pixels with a NaN or an infinity in either picture; they are in no other number but differing_bits.
  uint64_t not_finite = 0;
  uint64_t differing_bits = 0;  // pixels whose bits differ at all (so -0 and 0 differ, and equal NaNs do not)
};

// `floor`: absolute floor of the denominator, in the pictures' unit; 0: 1e-4 of b's mean luminance (Rec. 709
// for R, G, B; else the mean of the channels), or 1 where b is black all over. Sizes and channels must match,
// floor must not be negative (std::invalid_argument).
ImageDifference compare_images(const Picture& a, const Picture& b, double floor = 0);

}  // namespace ml
