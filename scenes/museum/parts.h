// The parts of the museum: rooms, columns, exhibits. Five rooms along x and three along z stand
// around x = z = 0; y is up, the floor is at 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/mesh_builder.h"

namespace ml {

struct MuseumMaterials {
  uint32_t marble, slate, ceiling, beam, trim, stone, gilt, bronze, wood;
  uint32_t paint[4], canvas[6], glaze[3];
};

constexpr int kMuseumRoomsX = 5, kMuseumRoomsZ = 3;
constexpr double kMuseumPitch = 14, kMuseumHeight = 7.5;  // m
constexpr double kMuseumWall = 0.6;                       // m, thickness; half of it within each room
constexpr double kDoorHalf = 1.5, kDoorHeight = 4.6;      // m

// The middle of a room's floor.
glm::dvec3 museum_room(int i, int k);

// Floors, ceilings, walls with doorways, and what hangs on them; a shell around all of it, seen from within,
// so that no crack shows the sky.
void build_museum_rooms(MeshBuilder& mesh, const MuseumMaterials& materials, Random& random);

// Returns their number.
int build_museum_columns(MeshBuilder& mesh, const MuseumMaterials& materials);

// Three plinths a room, clear of the lines between doorways, each with something on it.
int build_museum_exhibits(MeshBuilder& mesh, const MuseumMaterials& materials, Random& random);

}  // namespace ml
