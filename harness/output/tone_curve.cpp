#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "harness/base/check.h"
#include "harness/output/color_scale.h"
#include "harness/output/picture.h"

namespace ml {
namespace {

struct Rgb {
  double r = 0, g = 0, b = 0;
  bool has_nan() const { return std::isnan(r) || std::isnan(g) || std::isnan(b); }
  bool has_infinity() const { return std::isinf(r) || std::isinf(g) || std::isinf(b); }
  double luminance() const { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }  // ITU-R BT.709
};

Rgb rgb_at(const Picture& picture, size_t pixel) {
  const float* value = picture.data.data() + pixel * picture.channels.size();
  return picture.channels.size() < 3 ? Rgb{value[0], value[0], value[0]} : Rgb{value[0], value[1], value[2]};
}

// The factor that brings the 99th percentile of the lit pixels' luminance to white; 1 when nothing is lit.
float automatic_exposure(const Picture& picture, float white) {
  std::vector<double> lit;
  size_t pixels = static_cast<size_t>(picture.width) * picture.height;
  for (size_t i = 0; i < pixels; ++i) {
    Rgb color = rgb_at(picture, i);
    if (!color.has_nan() && !color.has_infinity() && color.luminance() > 0) lit.push_back(color.luminance());
  }
  if (lit.empty()) return 1;
  auto percentile = lit.begin() + static_cast<ptrdiff_t>((lit.size() - 1) * 99 / 100);
  std::nth_element(lit.begin(), percentile, lit.end());
  return static_cast<float>(std::clamp(white / *percentile, double{FLT_MIN}, double{FLT_MAX}));
}

}  // namespace

std::string ToneCurve::describe(float used_exposure) const {
  return fmt::format(
      "tone curve: x = exposure * value, exposure {:.6g}; x (1 + x / white^2) / (1 + x), white {:.6g}; sRGB; "
      "NaN magenta",
      used_exposure, white);
}

float write_preview_png(const Picture& rgb, const std::filesystem::path& file, const ToneCurve& curve) {
  ML_CHECK(!rgb.channels.empty());
  ML_CHECK_GT(curve.white, 0.0f);
  ML_CHECK_GE(curve.exposure, 0.0f);
  float exposure = curve.exposure > 0 ? curve.exposure : automatic_exposure(rgb, curve.white);
  double white_squared = double{curve.white} * curve.white;
  auto tone = [&](double value) {
    double x = std::max(0.0, value * exposure);
    return srgb_byte(x * (1 + x / white_squared) / (1 + x));
  };
  size_t pixels = static_cast<size_t>(rgb.width) * rgb.height;
  std::vector<uint8_t> bytes(pixels * 3);
  for (size_t i = 0; i < pixels; ++i) {
    Rgb color = rgb_at(rgb, i);
    Color out = not_finite_color;
    if (color.has_infinity() && !color.has_nan())
      out = {255, 255, 255};
    else if (!color.has_nan())
      out = {tone(color.r), tone(color.g), tone(color.b)};
    bytes[3 * i] = out.r, bytes[3 * i + 1] = out.g, bytes[3 * i + 2] = out.b;
  }
  write_png(rgb.width, rgb.height, bytes, file, curve.describe(exposure));
  return exposure;
}

}  // namespace ml
