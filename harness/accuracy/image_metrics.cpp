#include "harness/accuracy/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace ml {
namespace {

// Weight of each channel in the luminance.
std::vector<double> luminance_weights(const Picture& picture) {
  std::vector<double> weights;
  for (const std::string& name : picture.channels)
    weights.push_back(name == "R" ? 0.2126 : name == "G" ? 0.7152 : name == "B" ? 0.0722 : 0);
  double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (sum < 0.99) weights.assign(weights.size(), 1.0 / static_cast<double>(weights.size()));
  return weights;
}

bool finite(const float* values, size_t count) {
  return std::all_of(values, values + count, [](float value) { return std::isfinite(value); });
}

// Means over the pixels that are finite in both pictures.
struct Means {
  double value = 0, luminance = 0;
  uint64_t pixels = 0;
};

Means means_of(const Picture& a, const Picture& b) {
  size_t channels = b.channels.size(), count = static_cast<size_t>(b.width) * b.height;
  std::vector<double> weights = luminance_weights(b);
  Means means;
  for (size_t i = 0; i < count; ++i) {
    const float *pa = &a.data[i * channels], *pb = &b.data[i * channels];
    if (!finite(pa, channels) || !finite(pb, channels)) continue;
    ++means.pixels;
    for (size_t c = 0; c < channels; ++c)
      means.value += pb[c], means.luminance += weights[c] * std::abs(double{pb[c]});
  }
  if (means.pixels == 0) return means;
  means.value /= static_cast<double>(means.pixels * channels);
  means.luminance /= static_cast<double>(means.pixels);
  return means;
}

}  // namespace

ImageDifference compare_images(const Picture& a, const Picture& b, double floor) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw std::invalid_argument("pictures of different sizes or channels cannot be compared");
  if (!(floor >= 0) || !std::isfinite(floor))
    throw std::invalid_argument("the floor must be finite and not negative");
  size_t channels = b.channels.size();
  Means means = means_of(a, b);
  if (floor == 0) floor = means.luminance > 0 ? 1e-4 * means.luminance : 1;
  double softening = 1e-2 * means.value * means.value;

  ImageDifference result;
  double squares = 0, relative_squares = 0;
  for (uint32_t y = 0; y < b.height; ++y) {
    for (uint32_t x = 0; x < b.width; ++x) {
      const float *pa = &a.data[a.pixel(x, y)], *pb = &b.data[b.pixel(x, y)];
      if (std::memcmp(pa, pb, channels * sizeof(float)) != 0) ++result.differing_bits;
      if (!finite(pa, channels) || !finite(pb, channels)) {
        ++result.not_finite;
        continue;
      }
      for (size_t c = 0; c < channels; ++c) {
        double value = pb[c], difference = std::abs(pa[c] - value);
        if (difference == 0) continue;
        squares += difference * difference;
        // Where b and its mean are 0, there is nothing to relate to: the floor stands in.
        double denominator = value * value + softening;
        relative_squares += difference * difference / (denominator > 0 ? denominator : floor * floor);
        double relative = difference / std::max(std::abs(value), floor);
        if (relative > result.max_relative)
          result.max_relative = relative, result.worst_x = x, result.worst_y = y;
      }
    }
  }
  if (means.pixels > 0) {
    auto samples = static_cast<double>(means.pixels * channels);
    result.rmse = std::sqrt(squares / samples);
    result.rel_mse = relative_squares / samples;
  }
  return result;
}

}  // namespace ml
