#include "harness/scene/camera.h"

#include <algorithm>
#include <cmath>

#include "harness/base/check.h"

namespace ml {
namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The change per second of a quantity at key i: the slope between its neighbours, one-sided at the ends.
glm::dvec3 tangent(const std::vector<CameraKey>& keys, size_t i, glm::dvec3 CameraKey::*value) {
  const CameraKey& before = keys[i == 0 ? 0 : i - 1];
  const CameraKey& after = keys[std::min(i + 1, keys.size() - 1)];
  return (after.*value - before.*value) / (after.time - before.time);
}

// Cubic Hermite between keys i and i + 1; `u` in [0, 1].
glm::dvec3 hermite(const std::vector<CameraKey>& keys, size_t i, double u, glm::dvec3 CameraKey::*value) {
  double span = keys[i + 1].time - keys[i].time;
  double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * (keys[i].*value) + (u3 - 2 * u2 + u) * span * tangent(keys, i, value) +
         (3 * u2 - 2 * u3) * (keys[i + 1].*value) + (u3 - u2) * span * tangent(keys, i + 1, value);
}

// The carrier's world transform, relative to the scene's origin.
glm::dmat4 view_of(const CameraNode& carrier, double time) {
  glm::dmat4 world = carrier.motions->world(carrier.node, time);
  world[3] -= glm::dvec4(carrier.center, 0);
  return world;
}

}  // namespace

Projection Projection::perspective(float vertical_fov, float aspect, float near, float far) {
  ML_CHECK(vertical_fov > 0 && vertical_fov < 3.1415927f && aspect > 0 && near > 0);
  ML_CHECK_GT(far, near);
  double half = std::tan(0.5 * static_cast<double>(vertical_fov));
  auto top = static_cast<float>(half);
  auto right = static_cast<float>(half * static_cast<double>(aspect));
  return {ProjectionKind::perspective, -right, right, -top, top, near, far};
}

Projection Projection::orthographic(float half_width, float half_height, float near, float far) {
  ML_CHECK(half_width > 0 && half_height > 0 && near > 0);
  ML_CHECK_GT(far, near);
  return {ProjectionKind::orthographic, -half_width, half_width, -half_height, half_height, near, far};
}

Camera Camera::look_at(const glm::dvec3& position, const glm::dvec3& target, const Projection& projection,
                       const glm::dvec3& up) {
  glm::dvec3 ahead = target - position;
  // Divided by the largest component first, so that neither tiny nor huge distances leave the range of the
  // squares.
  double scale = std::max({std::abs(ahead.x), std::abs(ahead.y), std::abs(ahead.z)});
  glm::dvec3 forward(0, 0, -1);
  if (finite(ahead) && scale > 0) forward = glm::normalize(ahead / scale);
  glm::dvec3 side(0);
  if (const double length = glm::length(up); length > 1e-150 && std::isfinite(length))
    side = glm::cross(forward, up / length);
  if (glm::dot(side, side) < 1e-20) side = glm::cross(forward, glm::dvec3(0, 1, 0));
  // Within about 0.03 degrees of the vertical the world's up says nothing about the roll: then the picture's
  // top is -z when looking down, +z when looking up.
  if (up == glm::dvec3(0) && glm::dot(side, side) < 2.5e-7)
    side = glm::cross(forward, glm::dvec3(0, 0, forward.y < 0 ? -1 : 1));
  glm::dvec3 right = glm::normalize(side);
  Camera camera;
  camera.position = glm::vec3(position);
  camera.right = glm::vec3(right);
  camera.up = glm::vec3(glm::cross(right, forward));
  camera.forward = glm::vec3(forward);
  camera.projection = projection;
  return camera;
}

Camera Camera::of_node(const glm::dmat4& world, const Projection& projection) {
  const glm::dvec3 position(world[3]), back(world[2]);
  const double length = glm::length(back);
  return look_at(position, position - back / length, projection, glm::dvec3(world[1]));
}

Camera CameraPath::sample(uint32_t frame, uint32_t frames, uint32_t width, uint32_t height, float near,
                          float far) const {
  ML_CHECK(!keys.empty() && frames > 0 && width > 0 && height > 0);
  ML_CHECK_LT(frame, frames);
  float aspect = static_cast<float>(width) / static_cast<float>(height);
  Projection window = projection;
  if (has_projection) {
    // Height, offset, near and far are the file's; the width follows the picture, so that pixels stay square.
    float stretch = aspect * (window.top - window.bottom) / (window.right - window.left);
    window.left *= stretch;
    window.right *= stretch;
    if (window.kind == ProjectionKind::orthographic && reach > window.near)
      window.far = std::min(window.far, reach);
  } else {
    const float begin = own_near > 0 ? own_near : near, end = own_far > 0 ? own_far : far;
    // A camera whose near plane lies behind the level still has a depth range.
    window = Projection::perspective(vertical_fov, aspect, begin, end > begin ? end : 10 * begin);
    window.clips_far = clips_far;
  }

  if (carrier) return Camera::of_node(view_of(*carrier, carrier->motions->time_of(frame, frames)), window);
  if (keys.size() == 1 || frames == 1)
    return Camera::look_at(keys.front().position, keys.front().target, window, keys.front().up);
  if (frame + 1 == frames) return Camera::look_at(keys.back().position, keys.back().target, window);
  double time =
      keys.front().time + duration() * (static_cast<double>(frame) / static_cast<double>(frames - 1));
  auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                [](double t, const CameraKey& key) { return t < key.time; });
  auto i = static_cast<size_t>(
      std::clamp<std::ptrdiff_t>(after - keys.begin() - 1, 0, static_cast<std::ptrdiff_t>(keys.size()) - 2));
  double u = (time - keys[i].time) / (keys[i + 1].time - keys[i].time);
  return Camera::look_at(hermite(keys, i, u, &CameraKey::position), hermite(keys, i, u, &CameraKey::target),
                         window);
}

bool CameraPath::cuts(uint32_t frame, uint32_t frames) const {
  if (frame == 0) return true;
  if (!carrier) return false;
  const NodeMotions& motions = *carrier->motions;
  return motions.jumps(carrier->node, motions.time_of(frame - 1, frames), motions.time_of(frame, frames));
}

std::vector<glm::dvec3> CameraPath::positions(uint32_t frames) const {
  std::vector<glm::dvec3> positions;
  // The picture and its depth range move no camera.
  for (uint32_t frame = 0; frame < frames; ++frame)
    positions.emplace_back(sample(frame, frames, 1, 1, 0.1f, 1).position);
  return positions;
}

}  // namespace ml
