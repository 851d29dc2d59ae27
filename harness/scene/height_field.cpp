#include "harness/scene/height_field.h"

#include <algorithm>
#include <cmath>

namespace ml {

HeightField::HeightField(int cells, double cell, const std::function<double(double x, double z)>& height)
    : cells_(cells), cell_(cell) {
  heights_.reserve(static_cast<size_t>(cells + 1) * (cells + 1));
  for (int k = 0; k <= cells; ++k) {
    for (int i = 0; i <= cells; ++i) heights_.push_back(quantised(height(coordinate(i), coordinate(k))));
  }
}

void HeightField::stretch_below(double from, double lowest) {
  double found = *std::min_element(heights_.begin(), heights_.end());
  if (found >= from) return;
  double factor = (lowest - from) / (found - from);
  for (double& height : heights_) {
    if (height == found) {
      height = lowest;
    } else if (height < from) {
      height = quantised(from + (height - from) * factor);
    }
  }
}

bool HeightField::falling(int i, int k) const {
  return std::abs(at(i, k) - at(i + 1, k + 1)) <= std::abs(at(i + 1, k) - at(i, k + 1));
}

double HeightField::height(double x, double z) const {
  double gx = std::clamp((x + half_size()) / cell_, 0.0, static_cast<double>(cells_));
  double gz = std::clamp((z + half_size()) / cell_, 0.0, static_cast<double>(cells_));
  int i = std::min(static_cast<int>(gx), cells_ - 1), k = std::min(static_cast<int>(gz), cells_ - 1);
  double u = gx - i, v = gz - k;
  double a = at(i, k), b = at(i + 1, k), c = at(i, k + 1), d = at(i + 1, k + 1);
  if (falling(i, k)) return u >= v ? a + u * (b - a) + v * (d - b) : a + v * (c - a) + u * (d - c);
  return u + v <= 1 ? a + u * (b - a) + v * (c - a) : d + (1 - u) * (c - d) + (1 - v) * (b - d);
}

void HeightField::build(MeshBuilder& mesh,
                        const std::function<uint32_t(double x, double z, double rise)>& material) const {
  std::vector<uint32_t> vertices;
  vertices.reserve(heights_.size());
  for (int k = 0; k <= cells_; ++k) {
    for (int i = 0; i <= cells_; ++i) {
      int left = std::max(i - 1, 0), right = std::min(i + 1, cells_);
      int back = std::max(k - 1, 0), front = std::min(k + 1, cells_);
      double slope_x = (at(right, k) - at(left, k)) / (cell_ * (right - left));
      double slope_z = (at(i, front) - at(i, back)) / (cell_ * (front - back));
      vertices.push_back(mesh.vertex({coordinate(i), at(i, k), coordinate(k)}, {-slope_x, 1, -slope_z}));
    }
  }
  auto index = [&](int i, int k) { return vertices[static_cast<size_t>(k) * (cells_ + 1) + i]; };
  for (int k = 0; k < cells_; ++k) {
    for (int i = 0; i < cells_; ++i) {
      auto [low, high] = std::minmax({at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
      uint32_t chosen = material(coordinate(i) + 0.5 * cell_, coordinate(k) + 0.5 * cell_, high - low);
      if (falling(i, k)) {
        mesh.smooth_triangle(index(i, k), index(i, k + 1), index(i + 1, k + 1), chosen);
        mesh.smooth_triangle(index(i, k), index(i + 1, k + 1), index(i + 1, k), chosen);
      } else {
        mesh.smooth_triangle(index(i, k), index(i, k + 1), index(i + 1, k), chosen);
        mesh.smooth_triangle(index(i + 1, k), index(i, k + 1), index(i + 1, k + 1), chosen);
      }
    }
  }
}

}  // namespace ml
