// Sine and cosine from additions and multiplications alone: the same bits on every machine, which libm does
// not promise.
#pragma once

namespace ml {

// `value` less the nearest integer, for |value| < 2^51: adding 1.5 * 2^52 leaves no bits for a fraction.
// (std::floor is a library call on processors of 2003, which the program is built for.)
inline double from_nearest(double value) {
  return value - ((value + 0x1.8p52) - 0x1.8p52);
}

// sin(2 pi turns) to 1e-11, for |turns| < 2^50.
inline double sine_of_turns(double turns) {
  double x = from_nearest(turns);  // [-0.5, 0.5]
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
