#include "harness/frame/shadow_views.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/frame/frame_input.h"

namespace ml {
namespace {

constexpr float degrees = 0.017453292519943295f;
// m: nearer surfaces are not in the map, and count for nothing in what a map costs.
constexpr float near = 0.05f;

struct Caster {
  glm::vec3 position{0};  // m, camera-relative
  glm::vec3 direction{0, -1, 0};
  float angle = 90 * degrees;
};

Caster caster_of(const FrameLights& lights, size_t i) {
  Caster caster;
  caster.position = lights.core[i].position;
  if (lights.extra.empty()) return caster;
  const uint32_t shape = lights.core[i].id_shape >> 24;
  const gpu_data::LightExtra& extra = lights.extra[i];
  const bool cone = shape == ML_SHAPE_SPOT || shape == ML_SHAPE_WEDGE;
  if (cone || shape == ML_SHAPE_BOX) caster.direction = extra.direction;
  if (cone)
    caster.angle =
        std::clamp(2 * std::acos(std::clamp(extra.cos_outer, -1.0f, 1.0f)), 10 * degrees, 120 * degrees);
  return caster;
}

// Indices of the `count` lights of the largest radius that cast shadows, largest first.
std::vector<size_t> largest(const FrameLights& lights, uint32_t count) {
  std::vector<size_t> found;
  for (size_t i = 0; i < lights.count(); ++i) {
    if (lights.core[i].id_shape & ML_LIGHT_PROBE) continue;
    auto next = std::upper_bound(found.begin(), found.end(), i,
                                 [&](size_t a, size_t b) { return lights.radius[a] > lights.radius[b]; });
    if (next == found.end() && found.size() == count) continue;
    found.insert(next, i);
    if (found.size() > count) found.pop_back();
  }
  return found;
}

}  // namespace

std::vector<gpu_data::ViewData> shadow_views(const FrameInput& frame, uint32_t count, uint32_t size) {
  static const std::array<glm::vec3, 6> axes{glm::vec3(1, 0, 0),  glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1),
                                             glm::vec3(0, 0, -1), glm::vec3(0, -1, 0), glm::vec3(0, 1, 0)};
  std::vector<Caster> casters;
  for (size_t light : largest(frame.lights, count)) casters.push_back(caster_of(frame.lights, light));
  if (casters.empty()) casters.emplace_back();
  std::vector<gpu_data::ViewData> views;
  for (uint32_t i = 0; i < count; ++i) {
    Caster caster = casters[i % casters.size()];
    if (const size_t round = i / casters.size(); round > 0) {
      caster.direction = axes[(round - 1) % axes.size()];
      caster.angle = 90 * degrees;
    }
    const glm::dvec3 at = glm::dvec3(frame.view.camera) + glm::dvec3(caster.position);
    const Camera camera = Camera::look_at(at, at + glm::dvec3(caster.direction),
                                          Projection::perspective(caster.angle, 1, near, 1000));
    views.push_back(view_data(camera, size, size, 0));
  }
  return views;
}

}  // namespace ml
