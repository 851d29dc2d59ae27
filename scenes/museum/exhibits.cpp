#include <algorithm>
#include <array>

#include "harness/scene/lathe.h"
#include "harness/scene/turn.h"
#include "harness/scene/turned_mesh.h"
#include "scenes/museum/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

void build_column(MeshBuilder& mesh, const MuseumMaterials& materials, const glm::dvec3& foot) {
  constexpr double kHalf = 0.55, kCapital = kMuseumHeight - 0.75;
  mesh.box(foot - glm::dvec3(kHalf, 0, kHalf), foot + glm::dvec3(kHalf, 0.3, kHalf), materials.stone,
           kNoBottom);
  static constexpr std::array<glm::dvec2, 6> profile{{{0.54, 0.3},
                                                      {0.54, 0.45},
                                                      {0.42, 0.6},
                                                      {0.34, kCapital - 0.2},
                                                      {0.34, kCapital},
                                                      {0.55, kCapital + 0.3}}};
  build_lathe(mesh, foot, profile, 12, materials.marble);
  mesh.box(foot + glm::dvec3(-0.6, kCapital + 0.3, -0.6), foot + glm::dvec3(0.6, kMuseumHeight, 0.6),
           materials.stone, MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::top));
}

void build_ball(MeshBuilder& mesh, const glm::dvec3& middle, double radius, uint32_t material) {
  constexpr int kRings = 6;
  std::array<glm::dvec2, kRings + 1> profile;
  for (int i = 0; i <= kRings; ++i) {
    double turns = 0.5 * i / kRings;
    bool pole = i == 0 || i == kRings;
    profile[static_cast<size_t>(i)] = {pole ? 0 : radius * sine_of_turns(turns),
                                       -radius * cosine_of_turns(turns)};
  }
  build_lathe(mesh, middle, profile, 12, material);
}

void build_vase(MeshBuilder& mesh, const glm::dvec3& foot, double size, uint32_t material) {
  std::array<glm::dvec2, 7> profile{
      {{0.16, 0}, {0.14, 0.06}, {0.34, 0.42}, {0.3, 0.66}, {0.12, 0.84}, {0.2, 1}, {0, 0.96}}};
  for (glm::dvec2& point : profile) point *= size;
  build_lathe(mesh, foot, profile, 12, material);
}

// A head on shoulders.
void build_bust(MeshBuilder& mesh, const glm::dvec3& foot, uint32_t material) {
  static constexpr std::array<glm::dvec2, 6> profile{
      {{0.14, 0}, {0.14, 0.1}, {0.32, 0.3}, {0.26, 0.42}, {0.09, 0.5}, {0.09, 0.62}}};
  build_lathe(mesh, foot, profile, 10, material);
  build_ball(mesh, foot + glm::dvec3(0, 0.76, 0), 0.18, material);
}

// Slabs, each smaller than and turned against the one below.
void build_stack(MeshBuilder& mesh, Random& random, const glm::dvec3& foot, uint32_t material) {
  double y = 0, half = 0.38;
  for (int i = 0; i < 6; ++i) {
    double turns = between(random, 0, 0.25), height = between(random, 0.1, 0.2);
    TurnedMesh slab(mesh, foot, {sine_of_turns(turns), cosine_of_turns(turns)});
    slab.box({-half, y, -half}, {half, y + height, half}, material);
    y += height;
    half *= 0.82;
  }
}

void build_exhibit(MeshBuilder& mesh, const MuseumMaterials& materials, Random& random,
                   const glm::dvec3& foot) {
  uint32_t glaze = materials.glaze[random.below(3)];
  uint32_t metal = random.below(2) == 0 ? materials.bronze : materials.gilt;
  switch (random.below(5)) {
    case 0: {
      double radius = between(random, 0.3, 0.4);
      build_ball(mesh, foot + glm::dvec3(0, radius - 0.01, 0), radius, metal);
      break;
    }
    case 1:
      build_vase(mesh, foot, between(random, 0.8, 1.15), glaze);
      break;
    case 2:
      build_bust(mesh, foot, materials.marble);
      break;
    case 3:
      build_stack(mesh, random, foot, glaze);
      break;
    default:
      mesh.prism(foot, 1.1, 0.2, 0.13, 4, materials.stone);
      mesh.prism(foot + glm::dvec3(0, 1.1, 0), 0.25, 0.13, 0, 4, metal);
      break;
  }
}

}  // namespace

int build_museum_columns(MeshBuilder& mesh, const MuseumMaterials& materials) {
  constexpr double kAside = 4.8;
  int columns = 0;
  for (int k = 0; k < kMuseumRoomsZ; ++k) {
    for (int i = 0; i < kMuseumRoomsX; ++i) {
      for (double x : {-kAside, kAside}) {
        for (double z : {-kAside, kAside}) {
          build_column(mesh, materials, museum_room(i, k) + glm::dvec3(x, 0, z));
          ++columns;
        }
      }
    }
  }
  return columns;
}

int build_museum_exhibits(MeshBuilder& mesh, const MuseumMaterials& materials, Random& random) {
  constexpr double kAside = 2.9, kHalf = 0.45, kHeight = 1.1;
  int exhibits = 0;
  for (int k = 0; k < kMuseumRoomsZ; ++k) {
    for (int i = 0; i < kMuseumRoomsX; ++i) {
      uint32_t empty = random.below(4);
      for (uint32_t corner = 0; corner < 4; ++corner) {
        if (corner == empty) continue;
        double x = (corner & 1 ? kAside : -kAside) + between(random, -0.3, 0.3);
        double z = (corner & 2 ? kAside : -kAside) + between(random, -0.3, 0.3);
        glm::dvec3 foot = museum_room(i, k) + glm::dvec3(x, 0, z);
        mesh.box(foot - glm::dvec3(kHalf, 0, kHalf), foot + glm::dvec3(kHalf, 0.12, kHalf), materials.stone,
                 kNoBottom);
        double half = kHalf - 0.06;
        mesh.box(foot + glm::dvec3(-half, 0.12, -half), foot + glm::dvec3(half, kHeight, half),
                 materials.paint[0], kNoBottom);
        build_exhibit(mesh, materials, random, foot + glm::dvec3(0, kHeight, 0));
        ++exhibits;
      }
    }
  }
  return exhibits;
}

}  // namespace ml
