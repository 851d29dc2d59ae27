#include "harness/output/color_scale.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

// x^2.4 = x^2 * x^0.4, the fifth root of x^2 by Newton's method: no library function whose last bit differs
// between machines.
double power_2_4(double x) {
  double square = x * x, root = 1;
  for (int i = 0; i < 60; ++i) root = (4 * root + square / (root * root * root * root)) / 5;
  return square * root;
}

double srgb_to_linear(double code) {
  return code <= 0.04045 ? code / 12.92 : power_2_4((code + 0.055) / 1.055);
}

// Linear light halfway, in code, between each byte and the next.
const std::array<double, 255>& byte_limits() {
  static const std::array<double, 255> limits = [] {
    std::array<double, 255> table{};
    for (size_t i = 0; i < table.size(); ++i) table[i] = srgb_to_linear((static_cast<double>(i) + 0.5) / 255);
    return table;
  }();
  return limits;
}

using Lab = std::array<double, 3>;  // Oklab: lightness, green-red, blue-yellow

// A cubic Bezier curve through Oklab, chosen to stay inside sRGB; its parameter is no measure of distance.
Lab curve(double t) {
  constexpr std::array<Lab, 4> control{
      {{0.34, 0.035, -0.15}, {0.55, -0.075, -0.105}, {0.72, -0.165, 0.085}, {0.92, -0.05, 0.183}}};
  double s = 1 - t;
  std::array<double, 4> weight{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  Lab sum{};
  for (size_t i = 0; i < control.size(); ++i)
    for (size_t k = 0; k < sum.size(); ++k) sum[k] += weight[i] * control[i][k];
  return sum;
}

double cube(double x) {
  return x * x * x;
}

Color to_srgb(const Lab& lab) {
  double l = cube(lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2]);
  double m = cube(lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2]);
  double s = cube(lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2]);
  return {srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

constexpr size_t scale_steps = 256;

// The curve walked in fine steps, and a colour taken at every 1/255 of its length.
std::array<Color, scale_steps> make_scale() {
  constexpr int fine = 4096;
  std::array<double, fine + 1> length{};
  Lab before = curve(0);
  for (int i = 1; i <= fine; ++i) {
    Lab here = curve(static_cast<double>(i) / fine);
    double sum = 0;
    for (size_t k = 0; k < here.size(); ++k) sum += (here[k] - before[k]) * (here[k] - before[k]);
    length[static_cast<size_t>(i)] = length[static_cast<size_t>(i) - 1] + std::sqrt(sum);
    before = here;
  }
  std::array<Color, scale_steps> scale;
  for (size_t i = 0; i < scale_steps; ++i) {
    double wanted = length.back() * static_cast<double>(i) / (scale_steps - 1);
    auto at = std::lower_bound(length.begin(), length.end(), wanted);
    scale[i] = to_srgb(curve(static_cast<double>(at - length.begin()) / fine));
  }
  return scale;
}

}  // namespace

uint8_t srgb_byte(double linear) {
  if (std::isnan(linear)) return 0;
  const auto& limits = byte_limits();
  return static_cast<uint8_t>(std::upper_bound(limits.begin(), limits.end(), linear) - limits.begin());
}

Color scale_color(double t) {
  static const std::array<Color, scale_steps> scale = make_scale();
  double clamped = t > 0 ? std::min(t, 1.0) : 0;
  return scale[static_cast<size_t>(clamped * (scale_steps - 1) + 0.5)];
}

}  // namespace ml
