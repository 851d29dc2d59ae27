#include "harness/lights/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/error.h"

namespace ml {

SurfaceSampler::SurfaceSampler(const Scene& scene, bool by_area) : scene_(scene) {
  if (scene.triangle_count() == 0) {
    throw UsageError(one_line(fmt::format("scene '{}': it has no triangles to put lights on", scene.name)));
  }
  if (!by_area) return;
  double sum = 0;
  area_before_.reserve(scene.triangle_count() + 1);
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    area_before_.push_back(sum);
    glm::dvec3 a(scene.vertices[scene.indices[3 * i]].position);
    glm::dvec3 b(scene.vertices[scene.indices[3 * i + 1]].position);
    glm::dvec3 c(scene.vertices[scene.indices[3 * i + 2]].position);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  area_before_.push_back(sum);
  if (!(sum > 0)) {
    throw UsageError(
        one_line(fmt::format("scene '{}': its triangles have no area to put lights on", scene.name)));
  }
}

SurfaceSampler::Point SurfaceSampler::at(double choice, double u, double v) const {
  uint32_t last = scene_.triangle_count() - 1;
  uint32_t triangle;
  if (area_before_.empty()) {
    triangle = std::min(static_cast<uint32_t>(choice * scene_.triangle_count()), last);
  } else {
    // The last triangle whose area begins at or before the chosen one: never one without area.
    auto after = std::upper_bound(area_before_.begin(), area_before_.end(), choice * area_before_.back());
    triangle = std::min(static_cast<uint32_t>(after - area_before_.begin()) - 1, last);
  }
  const Vertex& va = scene_.vertices[scene_.indices[3 * triangle]];
  const Vertex& vb = scene_.vertices[scene_.indices[3 * triangle + 1]];
  const Vertex& vc = scene_.vertices[scene_.indices[3 * triangle + 2]];
  glm::dvec3 a(va.position), b(vb.position), c(vc.position);
  double root = std::sqrt(u);
  Point point;
  point.position = (1 - root) * a + root * (1 - v) * b + root * v * c;

  glm::dvec3 shading = glm::dvec3(va.normal) + glm::dvec3(vb.normal) + glm::dvec3(vc.normal);
  glm::dvec3 normal = glm::cross(b - a, c - a);
  double length = glm::length(normal);
  if (length > 0) {
    point.normal = normal / length;
    if (glm::dot(point.normal, shading) < 0) point.normal = -point.normal;
  } else {
    double shading_length = glm::length(shading);
    point.normal = shading_length > 0 ? shading / shading_length : glm::dvec3(0, 1, 0);
  }
  return point;
}

}  // namespace ml
