// Where each light of a run stands, by its placement (all but `gltf` and `stage`).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "harness/lights/clumps.h"
#include "harness/lights/placement.h"

namespace ml {

class LightPositions {
 public:
  // `scene` must outlive the positions. Throws UsageError when the scene cannot carry the placement.
  LightPositions(const LightSpec& spec, const Scene& scene);
  // m; the radius lifts lights off surfaces.
  glm::dvec3 at(uint32_t light, double radius) const;

 private:
  uint32_t seed_hash_;
  double height_;
  glm::dvec3 corner_, extent_;  // of the box that volume and room fill
  std::optional<SurfaceSampler> surface_;
  std::optional<ClumpSampler> clumps_;
};

}  // namespace ml
