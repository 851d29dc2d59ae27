#include "harness/camera/view_probe.h"

namespace ml {
namespace {

// Back sides that a ray may pass: more than any level has in a row in front of something that is drawn.
constexpr int kMaxBackSides = 32;

}  // namespace

ViewProbe::ViewProbe(const Scene& scene, const RayCaster& rays)
    : rays_(rays), double_sided_(scene.triangle_count(), false) {
  for (const Draw& draw : scene.draws) {
    if (!scene.materials[draw.material].double_sided) continue;
    for (uint32_t i = 0; i < draw.index_count / 3; ++i) double_sided_[draw.first_index / 3 + i] = true;
  }
}

double ViewProbe::seen(const Camera& camera, uint32_t columns, uint32_t rows) const {
  const Projection& window = camera.projection;
  const glm::dvec3 right(camera.right), up(camera.up), forward(camera.forward), eye(camera.position);
  const bool orthographic = window.kind == ProjectionKind::orthographic;
  uint32_t hits = 0;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const double x = window.left + (column + 0.5) / columns * (double{window.right} - double{window.left});
      const double y = window.bottom + (row + 0.5) / rows * (double{window.top} - double{window.bottom});
      const glm::dvec3 across = x * right + y * up;
      const glm::dvec3 direction = orthographic ? forward : forward + across;  // 1 m of depth long
      glm::dvec3 from = orthographic ? eye + across : eye;
      from += double{window.near} * direction;
      for (int passed = 0; passed < kMaxBackSides; ++passed) {
        const auto hit = rays_.nearest(from, direction);
        if (!hit) break;
        if (hit->front || double_sided_[hit->triangle]) {
          ++hits;
          break;
        }
        from += hit->distance * (1 + 1e-9) * direction;
      }
    }
  }
  return static_cast<double>(hits) / (static_cast<double>(columns) * rows);
}

}  // namespace ml
