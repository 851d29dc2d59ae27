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

}  // namespace

double oracle_falloff(double distance, double radius) {
  if (!(distance < radius)) return 0;
  double ratio = distance * distance / (radius * radius);
  double window = std::max(0.0, 1 - ratio * ratio);
  return window * window / std::max(distance * distance, 1e-4);
}

double oracle_cone(const OracleLight& light, double cosine) {
  if (!light.spot) return 1;
  if (!(cosine > light.cos_outer)) return 0;
  double factor = std::clamp(cosine * light.cone_scale + light.cone_offset, 0.0, 1.0);
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
    glm::dvec3 offset = light.position - point.position;
    double distance = glm::length(offset);
    bool touching = distance < coincident;
    glm::dvec3 to_light = touching ? point.normal : offset / distance;
    if (touching) distance = 0;

    double facing = glm::dot(point.normal, to_light);
    double cosine = -glm::dot(to_light, light.direction);
    double falloff = oracle_falloff(distance, light.radius), cone = oracle_cone(light, cosine);
    Condition in_reach{falloff > 0, std::abs(distance - light.radius) <= margin * light.radius};
    Condition faces{facing > 0, std::abs(facing) <= margin};
    double ramp = cosine * light.cone_scale + light.cone_offset;
    Condition in_cone{cone > 0, light.spot && (std::abs(cosine - light.cos_outer) <= margin ||
                                               std::abs(ramp) <= margin * std::abs(light.cone_scale))};

    bool contributes = in_reach.holds && faces.holds && in_cone.holds;
    bool possible =
        (in_reach.holds || in_reach.near) && (faces.holds || faces.near) && (in_cone.holds || in_cone.near);
    if (possible && (in_reach.near || faces.near || in_cone.near)) ++answer.marginal;
    if (!contributes) continue;
    ++answer.contributing;
    answer.radiance +=
        light.intensity * (falloff * cone * facing) * oracle_brdf(point, to_light, to_viewer, specular);
  }
  return answer;
}

}  // namespace ml
