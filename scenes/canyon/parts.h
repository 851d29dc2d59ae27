// The parts of the canyon: ground, buildings, rocks. x runs along the valley, y is up, the valley floor is at
// about 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/scene/mesh_builder.h"

namespace ml {

struct CanyonMaterials {
  uint32_t rock, sand, concrete, metal, wood;
};

// A stretch of level ground under a building.
struct Footprint {
  glm::dvec2 min, max;  // x, z in m
  double height = 0;    // m
};

// Middle line and half-width of the valley at x.
double canyon_center(double x);
double canyon_half_width(double x);

// Ground height on a grid, with buildings' footprints levelled.
class CanyonGround {
 public:
  static constexpr double kCell = 1.25;               // m
  static constexpr int kCellsX = 152, kCellsZ = 120;  // 190 x 150 m
  static constexpr double kMinX = -95, kMinZ = -75;
  static constexpr double kLowest = -2, kHighest = 38;  // the ground reaches both exactly

  CanyonGround(uint32_t seed, const std::vector<Footprint>& footprints);
  double height(double x, double z) const;  // bilinear; (x, z) inside the level
  void build(MeshBuilder& mesh, const CanyonMaterials& materials) const;

 private:
  double at(int i, int k) const { return heights_[static_cast<size_t>(k) * (kCellsX + 1) + i]; }
  std::vector<double> heights_;  // quantised, row by row along x
};

// The forts face the middle of the valley: side -1 is the western one, +1 the eastern one.
struct Fort {
  double side;
  double center_x, center_z;
  // A point of the fort: `forward` m towards the middle of the valley, `across` m along z.
  glm::dvec3 point(double forward, double y, double across) const {
    return {center_x - side * forward, y, center_z + across};
  }
};
Fort canyon_fort(double side);
void build_fort(MeshBuilder& mesh, const CanyonMaterials& materials, const Fort& fort);

// Along x from x0 to x0 + 48 m, 6 m wide around z.
struct Tunnel {
  double x0, z;
};
constexpr Tunnel kNorthTunnel{-34, -15.5}, kSouthTunnel{-14, 15.5};
void build_tunnel(MeshBuilder& mesh, const CanyonMaterials& materials, const Tunnel& tunnel);

// Across the valley at x = 26, the deck at 10 m.
constexpr double kBridgeX = 26, kBridgeDeck = 10;
void build_bridge(MeshBuilder& mesh, const CanyonMaterials& materials);

std::vector<Footprint> canyon_footprints();

// Rocks on the ground, none within 3 m of the points of `keep_clear` or on a footprint.
void build_rocks(MeshBuilder& mesh, const CanyonMaterials& materials, const CanyonGround& ground,
                 uint32_t seed, const std::vector<glm::dvec3>& keep_clear);

}  // namespace ml
