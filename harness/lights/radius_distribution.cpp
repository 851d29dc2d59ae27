#include "harness/lights/radius_distribution.h"

#include <cmath>

#include "harness/lights/clumps.h"

namespace ml {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr uint32_t kReferenceCount = 65536;
constexpr double kWantedOverdraw = 3;
// Between the measured 1.0 (open ground) and 1.9 (narrow streets) of the surface formula.
constexpr double kSurfaceGain = 1.4;

}  // namespace

float pareto_radius(float u, float s, float ratio) {
  double r = ratio;
  double radius = s / std::sqrt(1 - static_cast<double>(u) * (1 - 1 / (r * r)));
  return static_cast<float>(radius);
}

RadiusMoments radius_moments(double ratio) {
  // The limits for ratio -> 1, where the quotients below are 0 / 0.
  if (ratio < 1 + 1e-6) return {1, 1, 1};
  double scale = 2 / (1 - 1 / (ratio * ratio));
  return {scale * (1 - 1 / ratio), scale * std::log(ratio), scale * (ratio - 1)};
}

double size_for_count(double s0, uint32_t count, Sizing sizing, Placement placement) {
  if (sizing == Sizing::fixed_size || count == 0) return s0;
  double share = double{kReferenceCount} / count;
  const bool fills_space = placement == Placement::volume || placement == Placement::room;
  return s0 * (fills_space ? std::cbrt(share) : std::sqrt(share));
}

double surface_area(const Scene& scene) {
  double area = 0;
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    glm::dvec3 a(scene.vertices[scene.indices[i]].position);
    glm::dvec3 b(scene.vertices[scene.indices[i + 1]].position);
    glm::dvec3 c(scene.vertices[scene.indices[i + 2]].position);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

double default_base_size(const Scene& scene, Placement placement, double ratio) {
  if (placement == Placement::clumps) return clump_smallest_radius(kReferenceCount, scene);
  const LightDefaults& defaults = scene.light_defaults;
  double own = placement == Placement::volume     ? defaults.volume_size
               : placement == Placement::triangle ? defaults.triangle_size
                                                  : defaults.area_size;
  if (own > 0) return own;
  RadiusMoments moments = radius_moments(ratio);
  glm::dvec3 size(scene.bounds.size());
  double volume = size.x * size.y * size.z;
  if (placement == Placement::volume && volume > 0) {
    return std::cbrt(kWantedOverdraw * volume / (0.7 * kReferenceCount * (4 * kPi / 3) * moments.cube));
  }
  // A level without thickness has no volume: its lights lie on its surface.
  double area = surface_area(scene);
  if (!(area > 0)) return 1;
  return std::sqrt(kWantedOverdraw * area /
                   (kSurfaceGain * kReferenceCount * kPi * moments.square * (11.0 / 12)));
}

double intensity_for_radius(double radius) {
  // falloff(r / 2) = (1 - 1/16)^2 / (r/2)^2 = 3.515625 / r^2
  return radius * radius / 3.515625;
}

}  // namespace ml
