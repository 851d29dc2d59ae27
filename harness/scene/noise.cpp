#include "harness/scene/noise.h"

#include <algorithm>
#include <cmath>

#include "harness/base/random.h"

namespace ml {
namespace {

// Smooth noise in [-1, 1] with features of about 1.
double noise(uint32_t seed, double x, double z) {
  double fx = std::floor(x), fz = std::floor(z);
  auto ix = static_cast<int32_t>(fx), iz = static_cast<int32_t>(fz);
  double u = x - fx, v = z - fz;
  u = u * u * u * (u * (u * 6 - 15) + 10);
  v = v * v * v * (v * (v * 6 - 15) + 10);
  auto corner = [&](int32_t dx, int32_t dz) {
    return static_cast<double>(
        unit_float(hash_u32(seed, static_cast<uint32_t>(ix + dx), static_cast<uint32_t>(iz + dz))));
  };
  double near = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  double far = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return 2 * (near + v * (far - near)) - 1;
}

}  // namespace

double smooth_step(double low, double high, double value) {
  double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double rough(uint32_t seed, double x, double z) {
  double sum = 0, size = 0.55;
  for (uint32_t octave = 0; octave < 4; ++octave) {
    sum += size * noise(seed + octave * 101, x, z);
    x = 2.03 * x + 17.1;
    z = 2.03 * z - 9.7;
    size *= 0.5;
  }
  return sum;
}

}  // namespace ml
