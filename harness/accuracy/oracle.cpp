#include "harness/accuracy/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/accuracy/rounding.h"

namespace ml {
namespace {

constexpr double margin = 1e-5;  // relative

// One condition of contributing: whether it holds, and whether single precision may see it otherwise.
struct Condition {
  bool holds, near;
};

// In the axes of the box.
glm::dvec3 position_in_box(const OracleLight& light, const glm::dvec3& from_centre) {
  return {glm::dot(from_centre, light.side), glm::dot(from_centre, glm::cross(light.direction, light.side)),
          glm::dot(from_centre, light.direction)};
}

Condition inside_box(const OracleLight& light, const glm::dvec3& position) {
  bool inside = true, possible = true, near = false;
  for (int axis = 0; axis < 3; ++axis) {
    double extent = light.half_extents[axis], beyond = std::abs(position[axis]) - extent;
    bool at_face = std::abs(beyond) <= margin * std::max(extent, glm::length(position));
    inside = inside && beyond < 0;
    possible = possible && (beyond < 0 || at_face);
    near = near || at_face;
  }
  return {inside, possible && near};
}

// A light as one point sees it.
struct Sight {
  SourceSight source;
  double blur;            // relative margin of directions
  double falloff;         // with the window
  double inverse_square;  // 1/m^2, the part of `falloff` that is no window
  Range window;           // not squared
  Condition in_reach;
};

Sight see(const SurfacePoint& point, const OracleLight& light) {
  const glm::dvec3 from_centre = point.position - light.position;
  const double along = std::clamp(glm::dot(from_centre, light.side), -light.half_length, light.half_length);
  const double lever = std::abs(along);
  Sight sight;
  sight.source = see_source(point, light, from_centre, along);
  const double distance = sight.source.distance;
  sight.blur = lever > 0 ? margin * (1 + lever / distance) : margin;
  sight.window = window_range(sight.source, light, from_centre);
  if (light.box) {
    const glm::dvec3 position = position_in_box(light, from_centre);
    sight.falloff = oracle_box_falloff(position, light.half_extents);
    sight.in_reach = inside_box(light, position);
  } else {
    sight.falloff = oracle_falloff(distance, light.radius);
    sight.in_reach = {sight.falloff > 0,
                      std::abs(distance - light.radius) <= margin * (light.radius + lever)};
  }
  sight.in_reach.near |= sight.window.undecided();
  sight.inverse_square = 1 / std::max(distance * distance, 1e-4);
  return sight;
}

// Whether a point at this position is clearly farther away than the light reaches.
bool out_of_reach(const SurfacePoint& point, const OracleLight& light) {
  const double reach = (light.box ? glm::length(light.half_extents) : light.radius) + light.half_length;
  const double distance = glm::length(point.position - light.position);
  return distance > reach + 1e-4 * (reach + distance + glm::length(point.position));
}

// Adds what a contribution may be off. Products that come near the smallest numbers of single precision may
// be lost whole.
void add_error(const glm::dvec3& value, const Range& strength, const Range (&reflected)[3],
               const glm::dvec3& intensity, OracleAnswer& answer, glm::dvec3& highest) {
  constexpr double may_vanish = 1e-30, roundings = 24 * rounding_unit;
  for (int channel = 0; channel < 3; ++channel) {
    Range range = (intensity[channel] * (strength * reflected[channel])).widened(roundings);
    if (strength.low < may_vanish) range.low = 0;
    answer.tolerance[channel] += std::max(range.high - value[channel], value[channel] - range.low);
    highest[channel] += range.high;
  }
}

}  // namespace

double oracle_falloff(double distance, double radius) {
  if (!(distance < radius)) return 0;
  double ratio = distance * distance / (radius * radius);
  double window = std::max(0.0, 1 - ratio * ratio);
  return window * window / std::max(distance * distance, 1e-4);
}

double oracle_box_falloff(const glm::dvec3& position, const glm::dvec3& half_extents) {
  double window = 1;
  for (int axis = 0; axis < 3; ++axis) {
    double l = std::abs(position[axis]), h = half_extents[axis];
    if (!(l < h)) return 0;
    window *= std::max(0.0, 1 - std::pow(l / h, 4));
  }
  return window * window / std::max(glm::dot(position, position), 1e-4);
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
  double signed_nh = std::clamp(glm::dot(point.normal, half), -1.0, 1.0), nh = std::max(signed_nh, 0.0);
  double vh = std::clamp(glm::dot(to_viewer, half), 0.0, 1.0);

  double rough = std::max(point.roughness, 0.045);
  double alpha2 = rough * rough * rough * rough;
  double lobe = nh * nh * alpha2 + (1 - signed_nh * signed_nh);
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
  answer.radiance = point.emission;
  glm::dvec3 highest = point.emission;  // and what the lights may give at most on top of it
  uint32_t possible_lights = 0;
  for (const OracleLight& light : lights) {
    if (out_of_reach(point, light)) continue;
    const Sight sight = see(point, light);
    const glm::dvec3& to_light = sight.source.to_light;
    const double facing = glm::dot(point.normal, to_light),
                 off_axis = 1 + glm::dot(to_light, light.direction);
    const double cone = oracle_cone(light, 1 - off_axis);
    const Range cones = cone_range(sight.source, light, off_axis);
    const Range facings = light.probe ? Range{1, 1} : facing_range(sight.source, facing);
    const Condition in_reach = sight.in_reach;
    Condition faces{facing > 0, std::abs(facing) <= sight.blur || facings.undecided()};
    if (light.probe) faces = {true, false};
    const Condition in_cone{
        cone > 0, light.spot && (std::abs(light.cone_limit - off_axis) <= sight.blur || cones.undecided())};

    const bool contributes = in_reach.holds && faces.holds && in_cone.holds;
    const bool possible =
        (in_reach.holds || in_reach.near) && (faces.holds || faces.near) && (in_cone.holds || in_cone.near);
    if (!possible) continue;
    ++possible_lights;
    if (in_reach.near || faces.near || in_cone.near) ++answer.marginal;
    answer.contributing += contributes;

    const glm::dvec3 diffuse = point.albedo * (1 - point.metallic) / std::numbers::pi;
    glm::dvec3 value{0};
    Range strength = sight.window * sight.window * cones * cones;
    Range reflected[3] = {{diffuse.x, diffuse.x}, {diffuse.y, diffuse.y}, {diffuse.z, diffuse.z}};
    if (light.probe) {
      const double window = sight.falloff / sight.inverse_square;
      if (contributes) value = light.intensity * (window * cone) * diffuse;
    } else {
      strength = strength * facings * inverse_square_range(sight.source);
      if (contributes)
        value = light.intensity * (sight.falloff * cone * facing) *
                oracle_brdf(point, to_light, to_viewer, specular);
      if (specular) {
        const HighlightRange highlight = highlight_range(point, sight.source, to_viewer, facings);
        const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), point.albedo, point.metallic);
        for (int channel = 0; channel < 3; ++channel)
          reflected[channel] =
              reflected[channel] +
              (Range{f0[channel], f0[channel]} + (1 - f0[channel]) * highlight.grazing) * highlight.lobe;
      }
    }
    answer.radiance += value;
    add_error(value, strength, reflected, light.intensity, answer, highest);
  }
  // Each addition rounds the sum so far.
  answer.tolerance += (possible_lights + 4.0) * rounding_unit * highest + glm::dvec3(1e-36);
  return answer;
}

}  // namespace ml
