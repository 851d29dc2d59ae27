#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/random.h"
#include "harness/scene/turn.h"
#include "scenes/canyon/parts.h"

namespace ml {
namespace {

constexpr double kGolden = 1.618033988749895;
constexpr std::array<glm::dvec3, 12> kCorners{{{-1, kGolden, 0},
                                               {1, kGolden, 0},
                                               {-1, -kGolden, 0},
                                               {1, -kGolden, 0},
                                               {0, -1, kGolden},
                                               {0, 1, kGolden},
                                               {0, -1, -kGolden},
                                               {0, 1, -kGolden},
                                               {kGolden, 0, -1},
                                               {kGolden, 0, 1},
                                               {-kGolden, 0, -1},
                                               {-kGolden, 0, 1}}};
constexpr uint8_t kFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                   {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

// A bumpy icosahedron, turned about the vertical, its lower part in the ground.
void build_rock(MeshBuilder& mesh, Random& random, const glm::dvec3& position, double radius,
                uint32_t material) {
  double turns = random.uniform(), c = cosine_of_turns(turns), s = sine_of_turns(turns);
  // In braces: from left to right with every compiler.
  glm::dvec3 stretch{random.uniform(0.8f, 1.3f), random.uniform(0.6f, 0.95f), random.uniform(0.8f, 1.2f)};
  std::array<glm::dvec3, 12> corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    double size =
        radius * static_cast<double>(random.uniform(0.8f, 1.15f)) / std::sqrt(1 + kGolden * kGolden);
    glm::dvec3 p = kCorners[i] * stretch * size;
    corners[i] = position + glm::dvec3(c * p.x - s * p.z, p.y + 0.25 * radius, s * p.x + c * p.z);
    corners[i].y = std::max(corners[i].y, CanyonGround::kLowest);
  }
  for (const auto& face : kFaces)
    mesh.triangle(corners[face[0]], corners[face[1]], corners[face[2]], material);
}

bool on_footprint(const std::vector<Footprint>& footprints, double x, double z, double margin) {
  return std::any_of(footprints.begin(), footprints.end(), [&](const Footprint& f) {
    return x > f.min.x - margin && x < f.max.x + margin && z > f.min.y - margin && z < f.max.y + margin;
  });
}

}  // namespace

void build_rocks(MeshBuilder& mesh, const CanyonMaterials& materials, const CanyonGround& ground,
                 uint32_t seed, const std::vector<glm::dvec3>& keep_clear) {
  constexpr int kRocks = 160, kTries = 20000;
  std::vector<Footprint> footprints = canyon_footprints();
  Random random(hash_u32(seed, 77));
  int built = 0;
  for (int i = 0; i < kTries && built < kRocks; ++i) {
    double x = random.uniform(-86, 86);
    // Most lie in the valley, thickest at the foot of its walls; some on the rim.
    double across = random.uniform(-1, 1);
    double reach = built % 4 == 3 ? canyon_half_width(x) + 30 : canyon_half_width(x) + 1;
    double z = canyon_center(x) + reach * (across < 0 ? -std::sqrt(-across) : std::sqrt(across));
    if (std::abs(z) > 70) continue;
    double u = random.uniform();
    double radius = 0.35 + 1.9 * u * u * u;
    glm::dvec3 position(x, ground.height(x, z), z);
    if (position.y > 32 || on_footprint(footprints, x, z, radius)) continue;
    bool in_the_way = std::any_of(keep_clear.begin(), keep_clear.end(), [&](const glm::dvec3& point) {
      return glm::length(point - position) < 3 + 1.6 * radius;
    });
    if (in_the_way) continue;
    build_rock(mesh, random, position, radius, materials.rock);
    ++built;
  }
}

}  // namespace ml
