// The parts of the arena: objects of five kinds, a house of one room. The middle is at x = z =
// 0; y is up, the ground is at 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/mesh_builder.h"

namespace ml {

struct ArenaMaterials {
  uint32_t grass, earth, concrete, plaster, roof, metal, bark;
  uint32_t wood[2], cloth[3], leaves[2];
};

constexpr double kArenaHalf = 45;                             // m, |x| and |z| of the ground's edge
constexpr double kArenaWall = 0.5;                            // m, thickness of the wall around it
constexpr double kRoomHalf = 6, kRoomHeight = 4;              // m, inside
constexpr double kRoomX = 27, kRoomZ = -27, kRoomWall = 0.4;  // m, its middle and its walls
constexpr int kCrates = 150, kRamps = 50, kWalls = 90, kTents = 50, kTrees = 110;  // 450 objects

void build_arena_ground(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random);
// The room with what stands in it; its door looks to -x.
void build_arena_house(MeshBuilder& mesh, const ArenaMaterials& materials);

void build_crate(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random, const glm::dvec3& foot,
                 const glm::dvec2& ahead, double size);

// All objects, none near the points of `keep_clear`, the house or one another. Returns their number.
int build_arena_objects(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random,
                        const std::vector<glm::dvec3>& keep_clear);

}  // namespace ml
