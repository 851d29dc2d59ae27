#include "harness/accuracy/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ml {
namespace {

constexpr double coincident = 1e-6;  // m
constexpr double margin = 1e-5;      // relative

// One condition of contributing: whether it holds, and whether single precision may see it otherwise.
struct Condition {
  bool holds, near;
};

// A light as one point sees it.
struct Sight {
  glm::dvec3 to_light;  // unit, to the nearest point of the source
  double distance;      // m
  double blur;          // relative rounding of `to_light` in single precision, generously
  double falloff;
  double inverse_square;  // 1/m^2, the part of `falloff` that is no window
  Condition in_reach;
};

// In the axes of the box.
glm::dvec3 place_in_box(const OracleLight& light, const glm::dvec3& from_centre) {
  return {glm::dot(from_centre, light.side), glm::dot(from_centre, glm::cross(light.direction, light.side)),
          glm::dot(from_centre, light.direction)};
}

Condition inside_box(const OracleLight& light, const glm::dvec3& place) {
  bool inside = true, possible = true, near = false;
  for (int axis = 0; axis < 3; ++axis) {
    double extent = light.half_extents[axis], beyond = std::abs(place[axis]) - extent;
    bool at_face = std::abs(beyond) <= margin * std::max(extent, glm::length(place));
    inside = inside && beyond < 0;
    possible = possible && (beyond < 0 || at_face);
    near = near || at_face;
  }
  return {inside, possible && near};
}

Sight see(const SurfacePoint& point, const OracleLight& light) {
  const glm::dvec3 from_centre = point.position - light.position;
  const double along = std::clamp(glm::dot(from_centre, light.side), -light.half_length, light.half_length);
  const glm::dvec3 offset = light.side * along - from_centre;
  const double lever = std::abs(along);
  Sight sight;
  sight.distance = glm::length(offset);
  sight.blur = lever > 0 ? margin * (1 + lever / sight.distance) : margin;
  const bool touching = sight.distance < coincident;
  sight.to_light = touching ? point.normal : offset / sight.distance;
  if (touching) sight.distance = 0;
  if (light.box) {
    const glm::dvec3 place = place_in_box(light, from_centre);
    sight.falloff = oracle_box_falloff(place, light.half_extents);
    sight.in_reach = inside_box(light, place);
  } else {
    sight.falloff = oracle_falloff(sight.distance, light.radius);
    sight.in_reach = {sight.falloff > 0,
                      std::abs(sight.distance - light.radius) <= margin * (light.radius + lever)};
  }
  sight.inverse_square = 1 / std::max(sight.distance * sight.distance, 1e-4);
  return sight;
}

}  // namespace

double oracle_falloff(double distance, double radius) {
  if (!(distance < radius)) return 0;
  double ratio = distance * distance / (radius * radius);
  double window = std::max(0.0, 1 - ratio * ratio);
  return window * window / std::max(distance * distance, 1e-4);
}

double oracle_box_falloff(const glm::dvec3& place, const glm::dvec3& half_extents) {
  double window = 1;
  for (int axis = 0; axis < 3; ++axis) {
    double l = std::abs(place[axis]), h = half_extents[axis];
    if (!(l < h)) return 0;
    window *= std::max(0.0, 1 - std::pow(l / h, 4));
  }
  return window * window / std::max(glm::dot(place, place), 1e-4);
}

double oracle_cone(const OracleLight& light, double cosine) {
  if (!light.spot) return 1;
  double factor = std::clamp((light.cone_limit - (1 - cosine)) * light.cone_scale, 0.0, 1.0);
  return factor * factor;
}

glm::dvec3 oracle_brdf(const SurfacePoint& point, const glm::dvec3& to_light, const glm::dvec3& to_viewer,
                       bool specular) {
  glm::dvec3 diffuse = point.albedo * (1 - point.metallic) / std::numbers::pi;
  if (!specular) return diffuse;

  glm::dvec3 sum = to_light + to_viewer;
  double length = glm::length(sum);
  glm::dvec3 half = length > 0 ? sum / length : point.normal;
  double nl = glm::dot(point.normal, to_light);
  double nv = std::max(std::abs(glm::dot(point.normal, to_viewer)), 1e-4);
  double nh = std::clamp(glm::dot(point.normal, half), 0.0, 1.0);
  double vh = std::clamp(glm::dot(to_viewer, half), 0.0, 1.0);

  double rough = std::max(point.roughness, 0.045);
  double alpha2 = rough * rough * rough * rough;
  double lobe = nh * nh * (alpha2 - 1) + 1;
  double distribution = alpha2 / (std::numbers::pi * lobe * lobe);
  double visibility = 0.5 / (nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) +
                             nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
  glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), point.albedo, point.metallic);
  glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - vh, 5);
  return diffuse + distribution * visibility * fresnel;
}

OracleAnswer oracle_shade(const SurfacePoint& point, std::span<const OracleLight> lights, bool specular) {
  glm::dvec3 to_viewer = point.view;
  if (to_viewer == glm::dvec3(0)) {
    double range = glm::length(point.position);
    to_viewer = range > 0 ? -point.position / range : point.normal;
  }
  OracleAnswer answer;
  for (const OracleLight& light : lights) {
    const Sight sight = see(point, light);
    const glm::dvec3& to_light = sight.to_light;
    double facing = glm::dot(point.normal, to_light);
    double cosine = -glm::dot(to_light, light.direction);
    double cone = oracle_cone(light, cosine);
    Condition in_reach = sight.in_reach;
    Condition faces{facing > 0, std::abs(facing) <= sight.blur};
    if (light.probe) faces = {true, false};
    Condition in_cone{cone > 0, light.spot && std::abs(light.cone_limit - (1 - cosine)) <= sight.blur};

    bool contributes = in_reach.holds && faces.holds && in_cone.holds;
    bool possible =
        (in_reach.holds || in_reach.near) && (faces.holds || faces.near) && (in_cone.holds || in_cone.near);
    if (possible && (in_reach.near || faces.near || in_cone.near)) ++answer.marginal;
    if (!contributes) continue;
    ++answer.contributing;
    if (light.probe) {
      const double window = sight.falloff / sight.inverse_square;
      answer.radiance +=
          light.intensity * (window * cone) * point.albedo * (1 - point.metallic) / std::numbers::pi;
      continue;
    }
    answer.radiance +=
        light.intensity * (sight.falloff * cone * facing) * oracle_brdf(point, to_light, to_viewer, specular);
  }
  return answer;
}

}  // namespace ml
