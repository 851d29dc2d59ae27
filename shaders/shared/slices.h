// The depth slices of a froxel grid: one near slice, then exponential ones from zmin to zmax (Persson 2013,
// "Practical Clustered Shading"; listing 4 of "Tiled Light Trees" has the scale upside down). ONE function
// for CPU and GPU, of exactly rounded operations only, so that both give the same slice for the same depth,
// bit for bit.
#ifndef ML_SHARED_SLICES_H
#define ML_SHARED_SLICES_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct SliceMapping {
  float log_min;  // slice_log2(zmin)
  float scale;    // slices per octave beyond zmin: (slices - 1) / (log2 zmax - log2 zmin); 0 for one slice
  uint count;     // slices, >= 1
};
ML_SIZE(SliceMapping, 12);

#ifdef __cplusplus
#define ML_PRECISE
#else
#define ML_PRECISE precise
#endif

// log2 of a positive, normal number within 1e-6; grows with it but for steps of its last bit (users widen
// bounds by 1e-5). Exponent from the bits; the rest, x = m - 1 with the mantissa m in [sqrt 1/2, sqrt 2), by
// a polynomial for log2(1 + x) / x fitted at Chebyshev nodes. Additions and multiplications only: those are
// exactly rounded on every device, divisions and log() are not.
ML_FUNCTION float slice_log2(float z) {
#ifdef __cplusplus
  uint bits;
  __builtin_memcpy(&bits, &z, 4);
#else
  uint bits = floatBitsToUint(z);
#endif
  // 0x3f3504f3 is sqrt 1/2: what it lacks to 1.0 carries into the exponent for mantissas from sqrt 2 up.
  uint shifted = bits + (0x3f800000u - 0x3f3504f3u);
  int exponent = int(shifted >> 23) - 127;
  uint mantissa = (shifted & 0x007fffffu) + 0x3f3504f3u;
#ifdef __cplusplus
  float m;
  __builtin_memcpy(&m, &mantissa, 4);
#else
  float m = uintBitsToFloat(mantissa);
#endif
  ML_PRECISE float x = m - 1.0f;
  ML_PRECISE float p = 0.123109683f;
  p = p * x + -0.205861881f;
  p = p * x + 0.216078222f;
  p = p * x + -0.239169881f;
  p = p * x + 0.287903249f;
  p = p * x + -0.360693276f;
  p = p * x + 0.480910748f;
  p = p * x + -0.721347451f;
  p = p * x + 1.44269502f;
  ML_PRECISE float result = float(exponent) + p * x;
  return result;
}

// Slice of a view depth in metres: [0, count). Depths at or below 0 and NaN are in slice 0; everything past
// zmax is in the last.
ML_FUNCTION uint slice_of_depth(float z, SliceMapping mapping) {
  if (!(z > 1e-30f)) return 0u;
  ML_PRECISE float slice = (slice_log2(z) - mapping.log_min) * mapping.scale + 1.0f;
  if (!(slice > 0.0f)) return 0u;
  float last = float(mapping.count - 1u);
  return slice >= last ? mapping.count - 1u : uint(slice);
}

ML_NAMESPACE_END
#endif
