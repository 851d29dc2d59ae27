#include <algorithm>
#include <cmath>

#include "harness/scene/noise.h"
#include "harness/scene/turn.h"
#include "scenes/citadel/parts.h"

namespace ml {
namespace {

constexpr int kCells = 152;
constexpr double kCell = 5;
constexpr double kTop = 38, kLowest = -4;

double distance(double x, double z) {
  return std::sqrt(x * x + z * z);
}

double raw_height(uint32_t seed, double x, double z) {
  double r = distance(x, z);
  double hill = kTop - (kTop - kWallFoot) * std::clamp((r - 22) / 76, 0.0, 1.0);
  if (r > 114) hill = kWallFoot * (1 - smooth_step(114, 205, r));
  // Rolling fields, and a low ridge at the level's edge that shuts the view.
  double fields = smooth_step(118, 210, r) * 5 * rough(seed + 1, x / 85, z / 85);
  double ridge = 13 * smooth_step(325, 378, std::max(std::abs(x), std::abs(z))) *
                 (0.7 + 0.5 * rough(seed + 2, x / 40, z / 40));
  return hill + fields + ridge;
}

}  // namespace

glm::dvec3 citadel_point(double turns, double radius, double y) {
  return {radius * sine_of_turns(turns), y, radius * cosine_of_turns(turns)};
}

HeightField make_citadel_ground(uint32_t seed) {
  HeightField ground(kCells, kCell, [&](double x, double z) { return raw_height(hash_u32(seed), x, z); });
  ground.stretch_below(0, kLowest);
  return ground;
}

void build_ground(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground) {
  ground.build(mesh, [&](double x, double z, double rise) {
    if (distance(x, z) < kWallRadius) return materials.cobbles;
    // The road to the gate.
    if (z > 0 && std::abs(x) < 5) return materials.earth;
    return rise > 1.9 ? materials.earth : materials.grass;
  });
}

}  // namespace ml
