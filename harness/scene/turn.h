// Sine and cosine from additions and multiplications alone: the same bits on every machine, which libm does not promise.
#pragma once

#include <cmath>

namespace ml {

// sin(2 pi turns) to 1e-11.
inline double sine_of_turns(double turns) {
  double x = turns - std::floor(turns + 0.5);  // [-0.5, 0.5)
  if (x > 0.25) x = 0.5 - x;
  if (x < -0.25) x = -0.5 - x;
  double a = x * 6.283185307179586;
  double q = a * a;
  // Taylor's series to a^15; |a| <= pi/2.
  double sum = -1.0 / 1307674368000.0;
  sum = sum * q + 1.0 / 6227020800.0;
  sum = sum * q - 1.0 / 39916800.0;
  sum = sum * q + 1.0 / 362880.0;
  sum = sum * q - 1.0 / 5040.0;
  sum = sum * q + 1.0 / 120.0;
  sum = sum * q - 1.0 / 6.0;
  sum = sum * q + 1.0;
  return sum * a;
}

inline double cosine_of_turns(double turns) {
  return sine_of_turns(turns + 0.25);
}

}  // namespace ml
