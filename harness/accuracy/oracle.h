// The double-precision CPU oracle: every light, straightforwardly, for given surface points. Shares no code with the GPU.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "harness/scene/light.h"

namespace ml {

// A shaded point, camera-relative (world axes), as the g-buffer has it.
struct SurfacePoint {
  glm::dvec3 position{0};  // m; the camera is at 0
  glm::dvec3 normal{0, 1, 0};
  glm::dvec3 albedo{0.5};
  double roughness = 0.8, metallic = 0;
};

// A light as the GPU has it, in double.
struct OracleLight {
  glm::dvec3 position{0};  // m, camera-relative
  double radius = 1;
  glm::dvec3 intensity{1};
  bool spot = false;
  glm::dvec3 direction{0, -1, 0};
  double cone_scale = 0, cone_offset = 1, cos_outer = -2;
};

struct OracleAnswer {
  glm::dvec3 radiance{0};
  uint32_t contributing = 0;
  // Lights so near to the edge of contributing (distance within 1e-5 of the radius, cosine within 1e-5 of 0 or of the cone's edge, relative)
  // that single precision may decide otherwise; they count in `contributing` by the double answer.
  uint32_t marginal = 0;
};

OracleAnswer oracle_shade(const SurfacePoint& point, std::span<const OracleLight> lights, bool specular);

// One light's windowed inverse-square falloff in double: (1 - (d/r)^2)^2 clamped at 0, over max(d^2, 1e-4 m^2).
double oracle_falloff(double distance, double radius);

}  // namespace ml
