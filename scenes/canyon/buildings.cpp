#include <algorithm>

#include "harness/scene/turn.h"
#include "scenes/canyon/parts.h"

namespace ml {
namespace {

using Mesh = MeshBuilder;

// A box between two corners in any order.
void block(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, uint32_t material,
           unsigned faces = Mesh::all) {
  mesh.box(glm::min(a, b), glm::max(a, b), material, faces);
}

// Merlons 1 m long, 1.2 m high and 0.5 m thick every 2 m along an edge from a to b, their outer side on the
// line; they stand towards `inward`.
void battlements(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& inward,
                 uint32_t material) {
  double length = glm::length(b - a);
  glm::dvec3 along = (b - a) / length;
  auto count = static_cast<int>((length + 1) / 2);
  double first = 0.5 * (length - (2 * count - 1));
  for (int i = 0; i < count; ++i) {
    glm::dvec3 begin = a + along * (first + 2 * i);
    block(mesh, begin, begin + along + 0.5 * inward + glm::dvec3(0, 1.2, 0), material,
          Mesh::all & ~Mesh::bottom);
  }
}

void build_tower(Mesh& mesh, const CanyonMaterials& materials, const glm::dvec3& foot) {
  constexpr int kSides = 12;
  mesh.prism(foot, 11.5, 3.0, 2.6, kSides, materials.concrete);
  // A crown that overhangs: its under side closes it.
  glm::dvec3 crown = foot + glm::dvec3(0, 11.5, 0);
  mesh.prism(crown, 1.5, 2.6, 3.1, kSides, materials.concrete);
  for (int i = 0; i < kSides; i += 2) {
    double turns = static_cast<double>(i) / kSides;
    glm::dvec3 position = crown + glm::dvec3(2.4 * cosine_of_turns(turns), 1.5, -2.4 * sine_of_turns(turns));
    mesh.prism(position, 1.0, 0.55, 0.55, 4, materials.concrete);
  }
  mesh.prism(crown + glm::dvec3(0, 1.5, 0), 5.0, 0.08, 0.05, 6, materials.metal);
  // The flag.
  block(mesh, crown + glm::dvec3(0.05, 4.9, -0.03), crown + glm::dvec3(1.9, 6.2, 0.03), materials.wood);
}

}  // namespace

Fort canyon_fort(double side) {
  return {side, 71 * side, 10 * side};
}

// Seen from above, in m towards the valley: the keep from -8 to 6, the curtain wall with its gate at 11 to
// 12, towers beside it.
void build_fort(Mesh& mesh, const CanyonMaterials& materials, const Fort& fort) {
  auto block_at = [&](double f0, double y0, double a0, double f1, double y1, double a1, uint32_t material,
                      unsigned faces = Mesh::all) {
    block(mesh, fort.point(f0, y0, a0), fort.point(f1, y1, a1), material, faces);
  };
  uint32_t stone = materials.concrete;
  const unsigned no_bottom = Mesh::all & ~Mesh::bottom;
  constexpr double kBack = -8, kFront = 6, kHalf = 8, kRoof = 7.6, kTop = 8.4, kDoor = 1.5, kDoorTop = 3.4;

  // The keep: floor, side walls, end walls with a doorway each, roof.
  block_at(kBack, -0.4, -kHalf, kFront, 0.12, kHalf, stone, no_bottom);
  for (double side : {-1.0, 1.0}) {
    block_at(kBack, 0.12, side * kHalf, kFront, kRoof, side * (kHalf - 1), stone, no_bottom);
    for (double end : {kBack, kFront - 1}) {
      block_at(end, 0.12, side * (kHalf - 1), end + 1, kRoof, side * kDoor, stone, no_bottom);
    }
  }
  for (double end : {kBack, kFront - 1}) block_at(end, kDoorTop, -kDoor, end + 1, kRoof, kDoor, stone);
  block_at(kBack, kRoof, -kHalf, kFront, kTop, kHalf, stone);
  glm::dvec3 inward = fort.point(0, 0, 0) - fort.point(1, 0, 0);
  glm::dvec3 south(0, 0, 1);
  battlements(mesh, fort.point(kFront, kTop, -kHalf), fort.point(kFront, kTop, kHalf), inward, stone);
  battlements(mesh, fort.point(kBack, kTop, -kHalf), fort.point(kBack, kTop, kHalf), -inward, stone);
  battlements(mesh, fort.point(kBack + 2, kTop, -kHalf), fort.point(kFront - 2, kTop, -kHalf), south, stone);
  battlements(mesh, fort.point(kBack + 2, kTop, kHalf), fort.point(kFront - 2, kTop, kHalf), -south, stone);

  // Inside: pillars with metal bands, beams, benches and crates.
  for (double f : {-4.0, 2.0}) {
    for (double a : {-4.0, 4.0}) {
      mesh.prism(fort.point(f, 0.12, a), kRoof - 0.12, 0.5, 0.4, 8, stone);
      mesh.prism(fort.point(f, 1.1, a), 0.25, 0.56, 0.56, 8, materials.metal);
    }
    block_at(f - 0.25, kRoof - 0.6, -kHalf + 1, f + 0.25, kRoof - 0.01, kHalf - 1, materials.wood);
  }
  block_at(-6, 0.12, 5.8, 3.5, 0.6, 6.6, materials.wood, no_bottom);
  block_at(-6.2, 0.12, -6.5, -4.8, 1.5, -5.1, materials.wood, no_bottom);
  block_at(-4.4, 0.12, -6.5, -3.4, 1.1, -5.5, materials.wood, no_bottom);
  block_at(1, 0.12, -6.4, 2.6, 1.7, -4.9, materials.metal, no_bottom);

  // Metal frames stand a little out of the doorways.
  for (double end : {kBack - 0.1, kFront - 0.1}) {
    for (double side : {-1.0, 1.0}) {
      block_at(end, 0, side * kDoor, end + 0.2, kDoorTop, side * (kDoor + 0.25), materials.metal);
    }
    block_at(end, kDoorTop, -kDoor - 0.25, end + 0.2, kDoorTop + 0.3, kDoor + 0.25, materials.metal);
  }

  // Curtain wall with a gate 4 m wide, a walk behind its battlements, and the towers.
  for (double side : {-1.0, 1.0}) {
    block_at(11, -0.4, side * 2, 12, 5, side * 9.5, stone, no_bottom);
    block_at(9.8, 3.6, side * 2, 11, 3.8, side * 9, materials.wood);
    for (double post : {2.4, 5.6, 8.8}) {
      block_at(9.9, -0.4, side * post, 10.1, 3.6, side * (post + 0.2), materials.wood, no_bottom);
    }
    build_tower(mesh, materials, fort.point(11, -0.4, side * 11));
  }
  block_at(11, 4, -2, 12, 5, 2, stone);
  battlements(mesh, fort.point(12, 5, -8.4), fort.point(12, 5, 8.4), inward, stone);
}

void build_tunnel(Mesh& mesh, const CanyonMaterials& materials, const Tunnel& tunnel) {
  double x0 = tunnel.x0, x1 = tunnel.x0 + 48, z0 = tunnel.z - 3, z1 = tunnel.z + 3;
  uint32_t concrete = materials.concrete;
  const unsigned no_bottom = Mesh::all & ~Mesh::bottom;
  mesh.box({x0, -0.4, z0}, {x1, 0.1, z1}, concrete, no_bottom);
  mesh.box({x0, 0.1, z0}, {x1, 4.2, z0 + 0.4}, concrete, no_bottom);
  mesh.box({x0, 0.1, z1 - 0.4}, {x1, 4.2, z1}, concrete, no_bottom);
  mesh.box({x0, 4.2, z0}, {x1, 4.8, z1}, concrete);
  for (double x : {x0, x1 - 0.6}) {
    mesh.box({x, -0.4, z0 - 0.5}, {x + 0.6, 5.4, z0}, concrete, no_bottom);
    mesh.box({x, -0.4, z1}, {x + 0.6, 5.4, z1 + 0.5}, concrete, no_bottom);
    mesh.box({x, 4.8, z0}, {x + 0.6, 5.4, z1}, concrete);
  }
  // Ribs every 4 m, a cable tray under the roof, a walkway.
  for (int i = 1; i < 12; ++i) {
    double x = x0 + 4 * i;
    mesh.box({x - 0.12, 0.1, z0 + 0.4}, {x + 0.12, 3.95, z0 + 0.6}, materials.metal, no_bottom);
    mesh.box({x - 0.12, 0.1, z1 - 0.6}, {x + 0.12, 3.95, z1 - 0.4}, materials.metal, no_bottom);
    mesh.box({x - 0.12, 3.95, z0 + 0.4}, {x + 0.12, 4.19, z1 - 0.4}, materials.metal);
  }
  mesh.box({x0 + 1, 3.5, z0 + 0.7}, {x1 - 1, 3.6, z0 + 1.1}, materials.metal);
  mesh.box({x0, 0.1, z1 - 1.3}, {x1, 0.25, z1 - 0.4}, materials.wood, no_bottom);
}

void build_bridge(Mesh& mesh, const CanyonMaterials& materials) {
  constexpr double kHalfWidth = 2, kHalfLength = 27;
  const unsigned no_bottom = Mesh::all & ~Mesh::bottom;
  for (double side : {-1.0, 1.0}) {
    double edge = kBridgeX + side * kHalfWidth, girder = edge - side * 0.5;
    block(mesh, {girder - side * 0.3, kBridgeDeck - 0.9, -kHalfLength},
          {girder, kBridgeDeck - 0.12, kHalfLength}, materials.metal);
    // Posts of 6 cm: thin, for depth edges.
    for (int i = 0; i <= 36; ++i) {
      double z = -22.5 + 1.25 * i;
      block(mesh, {edge - side * 0.06, kBridgeDeck, z - 0.03},
            {edge - side * 0.12, kBridgeDeck + 1.1, z + 0.03}, materials.metal, no_bottom);
    }
    for (double y : {0.55, 1.1}) {
      block(mesh, {edge - side * 0.05, kBridgeDeck + y - 0.03, -kHalfLength},
            {edge - side * 0.13, kBridgeDeck + y + 0.03, kHalfLength}, materials.metal);
    }
  }
  // Planks with open joints.
  for (int i = 0; i < 90; ++i) {
    double z = -kHalfLength + 0.6 * i;
    mesh.box({kBridgeX - kHalfWidth, kBridgeDeck - 0.12, z}, {kBridgeX + kHalfWidth, kBridgeDeck, z + 0.57},
             materials.wood);
  }
  for (double z : {-9.0, 9.0}) {
    mesh.box({kBridgeX - 1.4, -1.9, z - 0.7}, {kBridgeX + 1.4, kBridgeDeck - 1.5, z + 0.7},
             materials.concrete, no_bottom);
    mesh.box({kBridgeX - 2, kBridgeDeck - 1.5, z - 1}, {kBridgeX + 2, kBridgeDeck - 0.9, z + 1},
             materials.concrete);
  }
}

std::vector<Footprint> canyon_footprints() {
  std::vector<Footprint> list;
  for (const Tunnel& tunnel : {kNorthTunnel, kSouthTunnel}) {
    list.push_back({{tunnel.x0 - 2, tunnel.z - 3.5}, {tunnel.x0 + 50, tunnel.z + 3.5}, 0});
  }
  for (double side : {-1.0, 1.0}) {
    Fort fort = canyon_fort(side);
    glm::dvec3 a = fort.point(-9, 0, -14), b = fort.point(14.5, 0, 14);
    list.push_back({{std::min(a.x, b.x), a.z}, {std::max(a.x, b.x), b.z}, 0});
  }
  return list;
}

}  // namespace ml
