#include "harness/output/ticks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace ml {
namespace {

// n * 10^power, correctly rounded: powers of ten up to 10^22 are exact in double.
double decimal(double n, int power) {
  double ten = 1;
  for (int i = 0; i < std::abs(power); ++i) ten *= 10;
  return power < 0 ? n / ten : n * ten;
}

}  // namespace

std::string tick_label(double value, double end) {
  bool whole = value == std::floor(value) && end < 1e7;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::vector<double> scale_ticks(double end, bool integers, double length,
                                const std::function<double(const std::string&)>& label_pixels) {
  if (!(end > 0) || !std::isfinite(end) || !(length > 0)) return {};
  int exponent = static_cast<int>(std::floor(std::log10(end))) - 2;
  if (integers && exponent < 0) exponent = 0;
  for (int power = exponent; power <= exponent + 4; ++power) {
    for (int digit : {1, 2, 5}) {
      double step = decimal(digit, power);
      if (step >= end) return {};
      std::vector<double> ticks;
      bool fits = true;
      double free_from = 0, last_label = 0.5 * label_pixels(tick_label(end, end));
      for (int i = 1; i * step < end && fits; ++i) {
        double value = decimal(i * digit, power);
        double at = value / end * length, half = 0.5 * label_pixels(tick_label(value, end));
        if (at + half > length - last_label) break;
        fits = at - half >= free_from;
        free_from = at + half;
        ticks.push_back(value);
      }
      if (fits) return ticks;
    }
  }
  return {};
}

}  // namespace ml
