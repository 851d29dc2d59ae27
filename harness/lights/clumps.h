// Placement `clumps`: a Thomas process. 60 % of the lights (by hash) stand in 16 clumps, normally distributed
// about the clump's middle (2.5 m flat, 0.75 m up); the rest stand alone, uniform over the surfaces that face
// up. The middles are 1.5 m above such surfaces.
//
// Radii where a configuration names none: smallest and largest in m on 90 x 90 m (the arena), as powers of
// the count between; elsewhere times the square root of the level's flat extent, for the same overdraw.
//   50 lights 4 to 16, 500 lights 2 to 8, 3240 lights 0.8 to 4.8; above that the smallest falls with the
//   square root of the count, below 50 it stays.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "harness/lights/placement.h"

namespace ml {

inline constexpr uint32_t kClumps = 16;

// The clump of a light, none for a light that stands alone.
std::optional<uint32_t> clump_of(const LightNumbers& number);

double clump_smallest_radius(uint32_t count, const Scene& scene);
// Largest radius / smallest.
float clump_radius_ratio(uint32_t count);

class ClumpSampler {
 public:
  // `scene` must outlive the sampler. Throws UsageError when the scene has no triangles.
  ClumpSampler(const Scene& scene, uint32_t seed_hash);
  glm::dvec3 at(uint32_t light, double radius) const;

 private:
  SurfaceSampler::Point floor_point(Random& random) const;

  SurfaceSampler surface_;
  uint32_t seed_hash_;
  std::array<glm::dvec3, kClumps> feet_;  // below the middles
};

}  // namespace ml
