// A mesh builder for things that face any way: local metres, x to the left of z, y up.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "harness/scene/mesh_builder.h"

namespace ml {

class TurnedMesh {
 public:
  // The local z axis runs along `ahead` (x, z; any length but 0) from `origin`.
  TurnedMesh(MeshBuilder& mesh, const glm::dvec3& origin, const glm::dvec2& ahead)
      : mesh_(mesh), origin_(origin), ahead_(ahead / std::sqrt(glm::dot(ahead, ahead))) {}

  MeshBuilder& mesh() const { return mesh_; }
  glm::dvec3 point(double x, double y, double z) const {
    return origin_ + glm::dvec3(x * ahead_.y + z * ahead_.x, y, z * ahead_.y - x * ahead_.x);
  }
  glm::dvec3 point(const glm::dvec3& p) const { return point(p.x, p.y, p.z); }

  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint32_t material) const {
    mesh_.triangle(point(a), point(b), point(c), material);
  }
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
            uint32_t material) const {
    mesh_.quad(point(a), point(b), point(c), point(d), material);
  }
  void block(std::array<glm::dvec3, 8> corners, uint32_t material, unsigned faces = MeshBuilder::all) const {
    for (glm::dvec3& corner : corners) corner = point(corner);
    mesh_.block(corners, material, faces);
  }
  void box(const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material,
           unsigned faces = MeshBuilder::all) const {
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < 8; ++i)
      corners[i] = {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
    block(corners, material, faces);
  }

 private:
  MeshBuilder& mesh_;
  glm::dvec3 origin_;
  glm::dvec2 ahead_;  // unit length
};

}  // namespace ml
