#include <algorithm>
#include <array>
#include <cmath>

#include "harness/scene/lathe.h"
#include "harness/scene/turn.h"
#include "harness/scene/turned_mesh.h"
#include "scenes/arena/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

glm::dvec2 any_way(Random& random) {
  double turns = between(random, 0, 1);
  return {sine_of_turns(turns), cosine_of_turns(turns)};
}

void build_crates(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random,
                  const glm::dvec3& foot) {
  double size = between(random, 0.9, 1.7);
  build_crate(mesh, materials, random, foot, any_way(random), size);
  if (random.below(4) != 0) return;
  build_crate(mesh, materials, random, foot + glm::dvec3(0, size, 0), any_way(random), 0.7 * size);
}

// Local z runs up the ramp, to a landing.
void build_ramp(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot) {
  TurnedMesh turned(mesh, foot, any_way(random));
  double half = between(random, 0.7, 1.1), length = between(random, 1.6, 2.2);
  double height = between(random, 0.8, 1.5), level = 0.5;
  std::array<glm::dvec3, 8> corners;
  for (size_t i = 0; i < 8; ++i) {
    bool far = (i & 4) != 0;
    corners[i] = {i & 1 ? half : -half, i & 2 ? (far ? height : 0.04) : 0, far ? level : level - length};
  }
  uint32_t material = random.below(2) == 0 ? materials.concrete : materials.wood[0];
  turned.block(corners, material, kNoBottom);
  turned.box({-half, 0, level}, {half, height, level + 1}, material, kNoBottom);
  for (double side : {-1.0, 1.0}) {
    double x = side * (half - 0.06);
    turned.box({x - 0.04, height, level + 0.9}, {x + 0.04, height + 0.9, level + 0.98}, materials.metal,
               kNoBottom);
  }
  turned.box({-half, height + 0.82, level + 0.91}, {half, height + 0.9, level + 0.97}, materials.metal);
}

void build_wall(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot) {
  TurnedMesh turned(mesh, foot, any_way(random));
  double half = between(random, 1.2, 2.1), height = between(random, 1.2, 2.8);
  uint32_t material = random.below(3) == 0 ? materials.concrete : materials.plaster;
  turned.box({-half, 0, -0.15}, {half, height, 0.15}, material, kNoBottom);
  turned.box({-half - 0.05, height, -0.22}, {half + 0.05, height + 0.12, 0.22}, materials.roof);
  for (double end : {-half, half}) {
    turned.box({end - 0.25, 0, -0.25}, {end + 0.25, height - 0.25, 0.25}, materials.concrete, kNoBottom);
  }
}

// The ridge runs along local z; open in front.
void build_tent(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot) {
  TurnedMesh turned(mesh, foot, any_way(random));
  double half = between(random, 1.1, 1.5), length = between(random, 1.1, 1.6);
  double ridge = between(random, 1.5, 2.1), eaves = between(random, 0.1, 0.5);
  uint32_t cloth = materials.cloth[random.below(3)];
  for (bool right : {false, true}) {
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < 8; ++i) {
      bool out = ((i & 1) != 0) == right;
      double x = out ? (right ? half : -half) : 0;
      corners[i] = {x, (out ? eaves : ridge) + (i & 2 ? 0.06 : 0), i & 4 ? length : -length};
    }
    unsigned inner = right ? MeshBuilder::west : MeshBuilder::east;
    turned.block(corners, cloth, MeshBuilder::all & ~inner);
  }
  double back = 0.03 - length;
  turned.quad({-half, 0, back}, {half, 0, back}, {half, eaves, back}, {-half, eaves, back}, cloth);
  turned.triangle({-half, eaves, back}, {half, eaves, back}, {0, ridge, back}, cloth);
  glm::dvec3 front = turned.point(0, 0, length - 0.1), rear = turned.point(0, 0, 0.15 - length);
  for (const glm::dvec3& pole : {front, rear}) mesh.prism(pole, ridge - 0.01, 0.05, 0.05, 4, materials.metal);
}

void build_tree(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot) {
  double height = between(random, 3, 6.5);
  uint32_t leaves = materials.leaves[random.below(2)];
  double radius = std::min(0.26 * height, 1.4);
  if (random.below(2) == 0) {
    mesh.prism(foot, 0.3 * height, 0.04 * height, 0.03 * height, 5, materials.bark);
    for (int tier = 0; tier < 3; ++tier) {
      double low = height * (0.2 + 0.24 * tier);
      mesh.cone(foot + glm::dvec3(0, low, 0), 0.36 * height, radius * (1 - 0.22 * tier), 7, leaves);
    }
    return;
  }
  mesh.prism(foot, 0.6 * height, 0.035 * height, 0.025 * height, 5, materials.bark);
  std::array<glm::dvec2, 4> crown{
      {{0, 0.36 * height}, {radius, 0.58 * height}, {0.8 * radius, 0.84 * height}, {0, height}}};
  build_lathe(mesh, foot, crown, 8, leaves);
}

struct Kind {
  int count;
  double reach;  // m about the foot
  void (*build)(MeshBuilder&, const ArenaMaterials&, Random&, const glm::dvec3&);
};

bool in_the_way(const std::vector<glm::dvec3>& keep_clear, const glm::dvec3& foot, double reach) {
  constexpr double kTallest = 7.5;
  return std::any_of(keep_clear.begin(), keep_clear.end(), [&](const glm::dvec3& p) {
    double dx = p.x - foot.x, dz = p.z - foot.z, margin = reach + 0.9;
    return p.y < kTallest && dx * dx + dz * dz < margin * margin;
  });
}

}  // namespace

void build_crate(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot,
                 const glm::dvec2& ahead, double size) {
  TurnedMesh turned(mesh, foot, ahead);
  double half = 0.5 * size, inner = half - 0.05, edge = 0.12 * size;
  uint32_t material = materials.wood[random.below(2)];
  turned.box({-half, 0, -half}, {half, edge, half}, materials.wood[0], kNoBottom);
  turned.box({-inner, edge, -inner}, {inner, size - edge, inner}, material,
             MeshBuilder::west | MeshBuilder::east | MeshBuilder::north | MeshBuilder::south);
  turned.box({-half, size - edge, -half}, {half, size, half}, materials.wood[0]);
}

int build_arena_objects(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random,
                        const std::vector<glm::dvec3>& keep_clear) {
  static constexpr std::array<Kind, 5> kinds{{{kWalls, 2.2, build_wall},
                                              {kRamps, 2.0, build_ramp},
                                              {kTents, 1.9, build_tent},
                                              {kTrees, 1.45, build_tree},
                                              {kCrates, 1.2, build_crates}}};
  struct Footprint {
    glm::dvec3 foot;
    double reach;
  };
  std::vector<Footprint> footprints;
  for (const Kind& kind : kinds) {
    for (int built = 0; built < kind.count;) {
      double max_offset = kArenaHalf - kArenaWall - 0.3 - kind.reach;
      double x = between(random, -max_offset, max_offset), z = between(random, -max_offset, max_offset);
      glm::dvec3 foot(x, 0, z);
      double house = kRoomHalf + kRoomWall + 0.6 + kind.reach;
      if (std::abs(x - kRoomX) < house && std::abs(z - kRoomZ) < house) continue;
      bool crowded = std::any_of(footprints.begin(), footprints.end(), [&](const Footprint& other) {
        glm::dvec3 step = other.foot - foot;
        double apart = 0.8 * (other.reach + kind.reach);
        return glm::dot(step, step) < apart * apart;
      });
      if (crowded || in_the_way(keep_clear, foot, kind.reach)) continue;
      footprints.push_back({foot, kind.reach});
      kind.build(mesh, materials, random, foot);
      ++built;
    }
  }
  return static_cast<int>(footprints.size());
}

}  // namespace ml
