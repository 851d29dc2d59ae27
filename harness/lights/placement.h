// Where the lights of a run stand: points in the scene's box or on its triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/base/random.h"
#include "harness/lights/set.h"
#include "harness/scene/scene.h"

namespace ml {

// The dimensions of a light's random numbers: light i of seed s has the number unit_float(hash_u32(s, i,
// dimension)), so it keeps its position, colour and script whatever the count is.
enum class LightDimension : uint32_t {
  position_0,
  position_1,
  position_2,
  lift,
  radius,
  hue,
  shape,
  tilt,
  azimuth,
  cone,
  rate,
  phase,
  orbit,
  turn,
  aspect_0,
  aspect_1,
  clump,
  probe
};
class LightNumbers {
 public:
  // `seed_hash` is hash_u32(seed): the same for all lights.
  LightNumbers(uint32_t seed_hash, uint32_t light) : hash_(hash_u32(seed_hash + light)) {}
  float operator()(LightDimension dimension) const {
    return unit_float(hash_u32(hash_ + static_cast<uint32_t>(dimension)));
  }

 private:
  uint32_t hash_;
};

// Uniform over triangles or over area.
class SurfaceSampler {
 public:
  // `scene` must outlive the sampler. Throws UsageError when the scene has no triangles.
  SurfaceSampler(const Scene& scene, bool by_area);

  struct Point {
    glm::dvec3 position;
    glm::dvec3 normal;  // unit; on the side of the vertex normals
  };
  // From three numbers in [0, 1).
  Point at(double choice, double u, double v) const;

 private:
  const Scene& scene_;
  std::vector<double>
      area_before_;  // area of the triangles before each, then the whole; empty: all triangles alike
};

}  // namespace ml
