// Ground on a grid of square cells, two triangles each, smoothly shaded.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "harness/scene/mesh_builder.h"

namespace ml {

class HeightField {
 public:
  // The middle of the grid is at (0, 0); `height` is asked at its corners, and the answers are quantised.
  HeightField(int cells, double cell, const std::function<double(double x, double z)>& height);

  // Stretches what lies below `from` so that the lowest corner is at `lowest` exactly.
  void stretch_below(double from, double lowest);

  double half_size() const { return 0.5 * cells_ * cell_; }  // m
  // On the triangles; (x, z) beyond the edge is taken to the edge.
  double height(double x, double z) const;
  // `material` of the cell with this middle, whose corners lie within `rise` m of each other.
  void build(MeshBuilder& mesh,
             const std::function<uint32_t(double x, double z, double rise)>& material) const;

 private:
  double at(int i, int k) const { return heights_[static_cast<size_t>(k) * (cells_ + 1) + i]; }
  // The diagonal from (i, k) to (i + 1, k + 1), or the other: the one whose ends differ less.
  bool falling(int i, int k) const;
  double coordinate(int i) const { return i * cell_ - half_size(); }

  int cells_;
  double cell_;                  // m
  std::vector<double> heights_;  // quantised, row by row along x
};

}  // namespace ml
