#include <cmath>

#include "harness/scene/turn.h"
#include "scenes/citadel/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);
constexpr int kTowers = 28;

// Merlons every 2 m from x0 to x1 along local x, on a walk at height y, between z0 and z1.
void battlements(const TurnedMesh& mesh, double x0, double x1, double y, double z0, double z1,
                 uint32_t material) {
  auto count = static_cast<int>((x1 - x0 + 1) / 2);
  double first = 0.5 * (x0 + x1 - (2 * count - 1));
  for (int i = 0; i < count; ++i) {
    double x = first + 2 * i;
    mesh.box({x, y, z0}, {x + 1, y + 1.2, z1}, material, kNoBottom);
  }
}

void build_tower(MeshBuilder& mesh, const CitadelMaterials& materials, int number) {
  constexpr int kSides = 10;
  constexpr double kTop = 25.5;
  // Outside the walk, so that the walk is free from one end to the other.
  glm::dvec3 foot = citadel_point((number + 0.5) / kTowers, kWallRadius + 4.6, kWallFoot - 2);
  mesh.prism(foot, kTop - foot.y, 4.4, 4.0, kSides, materials.stone);
  glm::dvec3 crown(foot.x, kTop, foot.z);
  mesh.prism(crown, 1.2, 4.0, 4.5, kSides, materials.trim);
  crown.y += 1.2;
  if (number % 2 == 0) {
    mesh.prism(crown, 7, 4.3, 0, kSides, materials.tiles[1]);
    return;
  }
  for (int i = 0; i < kSides; i += 2) {
    double turns = static_cast<double>(i) / kSides;
    glm::dvec3 position = crown + glm::dvec3(3.7 * cosine_of_turns(turns), 0, -3.7 * sine_of_turns(turns));
    mesh.prism(position, 1.1, 0.7, 0.7, 4, materials.stone);
  }
}

// Two square towers and a room above the way in.
void build_gate(const TurnedMesh& mesh, const CitadelMaterials& materials) {
  constexpr double kHalf = 3, kArch = kWallFoot + 6.5, kTop = kWallFoot + 15;
  for (double side : {-1.0, 1.0}) {
    double a = side < 0 ? -8 : kHalf, b = side < 0 ? -kHalf : 8;
    mesh.box({a, kWallFoot - 2, -3}, {b, kTop, 4}, materials.stone, kNoBottom);
    battlements(mesh, a, b, kTop, 3.4, 4, materials.trim);
    battlements(mesh, a, b, kTop, -3, -2.4, materials.trim);
    double post = side < 0 ? -kHalf : kHalf - 0.25;
    mesh.box({post, kWallFoot - 1, 4}, {post + 0.25, kArch, 4.2}, materials.metal, kNoBottom);
    // A bar that the gate's leaf hangs from, and the leaf, folded back.
    double leaf = side < 0 ? -kHalf - 0.02 : kHalf - 0.18;
    mesh.box({leaf, kWallFoot - 1, -2.6}, {leaf + 0.2, kArch - 0.4, 0.2}, materials.wood, kNoBottom);
  }
  mesh.box({-kHalf, kArch, -2.5}, {kHalf, kTop - 2, 3.5}, materials.stone);
  battlements(mesh, -kHalf, kHalf, kTop - 2, 2.9, 3.5, materials.trim);
  mesh.box({-kHalf - 0.3, kArch, 4.02}, {kHalf + 0.3, kArch + 0.5, 4.3}, materials.metal);
}

}  // namespace

void build_ring_wall(MeshBuilder& mesh, const CitadelMaterials& materials) {
  double half = 0.5 / kTowers;
  double middle = kWallRadius * cosine_of_turns(half), length = 2 * kWallRadius * sine_of_turns(half);
  for (int i = 0; i < kTowers; ++i) {
    double turns = static_cast<double>(i) / kTowers;
    glm::dvec3 outward = citadel_point(turns, 1, 0);
    TurnedMesh wall(mesh, citadel_point(turns, middle, 0), {outward.x, outward.z});
    double end = 0.5 * length + 0.2;
    if (i == 0) {
      wall.box({-end, kWallFoot - 2, -2}, {-3.2, kWallWalk, 2}, materials.stone, kNoBottom);
      wall.box({3.2, kWallFoot - 2, -2}, {end, kWallWalk, 2}, materials.stone, kNoBottom);
      build_gate(wall, materials);
    } else {
      wall.box({-end, kWallFoot - 2, -2}, {end, kWallWalk, 2}, materials.stone, kNoBottom);
      battlements(wall, -end + 3.5, end - 3.5, kWallWalk, 1.5, 2, materials.trim);
    }
    build_tower(mesh, materials, i);
  }
}

void build_keep(MeshBuilder& mesh, const CitadelMaterials& materials) {
  constexpr double kFoot = 36;
  for (int side = 0; side < 4; ++side) {
    glm::dvec3 outward = citadel_point(0.25 * side, 1, 0);
    TurnedMesh face(mesh, glm::dvec3(0), {outward.x, outward.z});
    battlements(face, -kKeepHalf + 3, kKeepHalf - 3, kKeepRoof, kKeepHalf - 0.6, kKeepHalf, materials.trim);
    for (double x : {-6.0, 6.0}) {
      face.box({x - 0.7, kFoot, kKeepHalf}, {x + 0.7, kKeepRoof - 1.5, kKeepHalf + 0.8}, materials.trim,
               kNoBottom);
    }
    for (double x : {-3.2, 0.0, 3.2}) {
      face.box({x - 0.35, 41.5, kKeepHalf}, {x + 0.35, 43.2, kKeepHalf + 0.12}, materials.metal);
    }
    face.box({-1.4, kFoot, kKeepHalf}, {1.4, 40.4, kKeepHalf + 0.3}, materials.wood, kNoBottom);
    glm::dvec3 corner = face.point(kKeepHalf, kFoot, kKeepHalf);
    mesh.prism(corner, 14, 2.6, 2.4, 8, materials.stone);
    corner.y += 14;
    mesh.prism(corner, 0.8, 2.4, 2.9, 8, materials.trim);
    corner.y += 0.8;
    mesh.prism(corner, 6, 2.7, 0, 8, materials.tiles[0]);
  }
  mesh.box({-kKeepHalf, kFoot, -kKeepHalf}, {kKeepHalf, kKeepRoof, kKeepHalf}, materials.stone, kNoBottom);

  // The spire: a shaft with bands, a gallery, a long cone.
  glm::dvec3 position(0, kKeepRoof, 0);
  mesh.prism(position, 24, 4.2, 3.6, 8, materials.stone);
  for (double y : {53.0, 61.0}) {
    mesh.prism({0, y, 0}, 0.35, 3.7, 4.3, 8, materials.trim);
  }
  mesh.prism({0, 70, 0}, 1.5, 3.6, 4.8, 8, materials.trim);
  mesh.prism({0, 71.5, 0}, kSpireTop - 71.5, 4.5, 0, 8, materials.tiles[1]);
}

}  // namespace ml
