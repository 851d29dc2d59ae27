// Ranges of numbers that are not negative: what a quantity may be when its inputs are rounded.
#pragma once

#include <algorithm>

namespace ml {

struct Range {
  double low = 0, high = 0;  // 0 <= low <= high

  // `value` +- `error`, within [floor, ceiling].
  static Range around(double value, double error, double floor, double ceiling) {
    return {std::clamp(value - error, floor, ceiling), std::clamp(value + error, floor, ceiling)};
  }
  Range widened(double relative) const { return {low * (1 - relative), high * (1 + relative)}; }
  // Whether it may be 0, and may be more.
  bool undecided() const { return low <= 0 && high > 0; }
};

inline Range operator*(const Range& a, const Range& b) {
  return {a.low * b.low, a.high * b.high};
}
inline Range operator+(const Range& a, const Range& b) {
  return {a.low + b.low, a.high + b.high};
}
inline Range operator*(double factor, const Range& range) {
  return {factor * range.low, factor * range.high};
}

}  // namespace ml
