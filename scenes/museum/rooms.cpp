#include <algorithm>
#include <array>

#include "harness/scene/turned_mesh.h"
#include "scenes/museum/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);
constexpr unsigned kNoBack = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::north);
constexpr double kHalfRoom = kMuseumPitch / 2, kHalfWall = kMuseumWall / 2;
// Walls reach into floor and ceiling, so that nothing shows between them.
constexpr double kBelow = -0.1, kAbove = kMuseumHeight + 0.1;

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

void build_floor_and_ceiling(MeshBuilder& mesh, const MuseumMaterials& materials, const glm::dvec3& middle) {
  constexpr int kTiles = 7;
  constexpr double kTile = kMuseumPitch / kTiles;
  const glm::dvec3 corner = middle - glm::dvec3(kHalfRoom, 0, kHalfRoom);
  for (int k = 0; k < kTiles; ++k) {
    for (int i = 0; i < kTiles; ++i) {
      glm::dvec3 a = corner + glm::dvec3(i * kTile, 0, k * kTile);
      mesh.quad(a, a + glm::dvec3(0, 0, kTile), a + glm::dvec3(kTile, 0, kTile), a + glm::dvec3(kTile, 0, 0),
                (i + k) % 2 == 0 ? materials.marble : materials.slate);
    }
  }
  glm::dvec3 high = corner + glm::dvec3(0, kMuseumHeight, 0);
  mesh.quad(high, high + glm::dvec3(kMuseumPitch, 0, 0), high + glm::dvec3(kMuseumPitch, 0, kMuseumPitch),
            high + glm::dvec3(0, 0, kMuseumPitch), materials.ceiling);
  for (double across : {-3.5, 0.0, 3.5}) {
    mesh.box(middle + glm::dvec3(-kHalfRoom, kMuseumHeight - 0.35, across - 0.15),
             middle + glm::dvec3(kHalfRoom, kMuseumHeight, across + 0.15), materials.beam,
             MeshBuilder::bottom | MeshBuilder::north | MeshBuilder::south);
  }
}

// The wall between two rooms, or around all of them: local x along it, z across.
void build_wall(const TurnedMesh& wall, uint32_t paint, bool door) {
  if (!door) {
    wall.box({-kHalfRoom, kBelow, -kHalfWall}, {kHalfRoom, kAbove, kHalfWall}, paint);
    return;
  }
  wall.box({-kHalfRoom, kBelow, -kHalfWall}, {-kDoorHalf, kAbove, kHalfWall}, paint);
  wall.box({kDoorHalf, kBelow, -kHalfWall}, {kHalfRoom, kAbove, kHalfWall}, paint);
  wall.box({-kDoorHalf, kDoorHeight, -kHalfWall}, {kDoorHalf, kAbove, kHalfWall}, paint);
}

void build_picture(const TurnedMesh& side, const MuseumMaterials& materials, Random& random, double x) {
  double width = between(random, 0.7, 1.5), height = between(random, 0.6, 1.1), y = between(random, 2.0, 2.6);
  double back = kHalfWall;
  side.box({x - width, y - height, back}, {x + width, y + height, back + 0.08},
           random.below(3) == 0 ? materials.wood : materials.gilt, kNoBack);
  double edge = between(random, 0.08, 0.16);
  side.box({x - width + edge, y - height + edge, back}, {x + width - edge, y + height - edge, back + 0.1},
           materials.canvas[random.below(6)], kNoBack);
}

// What a visitor sees of a wall from within a room; local z points into the room.
void build_side(const TurnedMesh& side, const MuseumMaterials& materials, Random& random, bool door) {
  constexpr double kEnd = kHalfRoom - kHalfWall, kJamb = 0.3;
  double back = kHalfWall;
  side.box({-kEnd, kMuseumHeight - 0.3, back}, {kEnd, kMuseumHeight, back + 0.15}, materials.trim, kNoBack);
  if (door) {
    for (double sign : {-1.0, 1.0}) {
      double near = sign * kDoorHalf, far = sign * (kDoorHalf + kJamb);
      side.box({std::min(near, far), 0, back}, {std::max(near, far), kDoorHeight + kJamb, back + 0.08},
               materials.stone, kNoBack & kNoBottom);
      double end = sign * kEnd;
      side.box({std::min(far, end), 0, back}, {std::max(far, end), 0.25, back + 0.05}, materials.wood,
               kNoBack & kNoBottom);
    }
    side.box({-kDoorHalf, kDoorHeight, back}, {kDoorHalf, kDoorHeight + kJamb, back + 0.08}, materials.stone,
             kNoBack);
    side.box({-kDoorHalf - 0.5, kDoorHeight + kJamb, back},
             {kDoorHalf + 0.5, kDoorHeight + kJamb + 0.15, back + 0.2}, materials.trim, kNoBack);
  } else {
    side.box({-kEnd, 0, back}, {kEnd, 0.25, back + 0.05}, materials.wood, kNoBack & kNoBottom);
    build_picture(side, materials, random, between(random, -0.5, 0.5));
  }
  for (double x : {-4.2, 4.2}) build_picture(side, materials, random, x + between(random, -0.3, 0.3));
}

}  // namespace

glm::dvec3 museum_room(int i, int k) {
  return {(i - 0.5 * (kMuseumRoomsX - 1)) * kMuseumPitch, 0, (k - 0.5 * (kMuseumRoomsZ - 1)) * kMuseumPitch};
}

void build_museum_rooms(MeshBuilder& mesh, const MuseumMaterials& materials, Random& random) {
  for (int k = 0; k < kMuseumRoomsZ; ++k) {
    for (int i = 0; i < kMuseumRoomsX; ++i) {
      glm::dvec3 middle = museum_room(i, k);
      build_floor_and_ceiling(mesh, materials, middle);
      struct Direction {
        int x, z;
      };
      for (Direction out : {Direction{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        int ni = i + out.x, nk = k + out.z;
        bool door = ni >= 0 && ni < kMuseumRoomsX && nk >= 0 && nk < kMuseumRoomsZ;
        glm::dvec3 position = middle + kHalfRoom * glm::dvec3(out.x, 0, out.z);
        // Each wall once, by the room to its west or north, or by its only room.
        if (!door || out.x + out.z > 0)
          build_wall(TurnedMesh(mesh, position, {out.x, out.z}), materials.paint[random.below(4)], door);
        build_side(TurnedMesh(mesh, position, {-out.x, -out.z}), materials, random, door);
      }
    }
  }
  // Faces inwards: a block whose corners are named the other way round along x.
  glm::dvec3 reach(0.5 * kMuseumRoomsX * kMuseumPitch + kHalfWall, 0,
                   0.5 * kMuseumRoomsZ * kMuseumPitch + kHalfWall);
  std::array<glm::dvec3, 8> corners;
  for (size_t c = 0; c < 8; ++c) {
    corners[c] = {c & 1 ? -reach.x : reach.x, c & 2 ? kMuseumHeight + 0.5 : -0.5, c & 4 ? reach.z : -reach.z};
  }
  mesh.block(corners, materials.slate);
}

}  // namespace ml
