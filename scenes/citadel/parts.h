// The parts of the citadel: ground, fortification, houses, trees. The hill's top is at x = z = 0
// and the gate to its south (+z); y is up, the fields are at about 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/height_field.h"
#include "harness/scene/mesh_builder.h"
#include "harness/scene/turned_mesh.h"

namespace ml {

struct CitadelMaterials {
  uint32_t grass, earth, cobbles, stone, trim, metal, wood, needles;
  uint32_t plaster[3], tiles[2];
};

// The point `radius` m from the middle, `turns` round it: 0 is south, 0.25 east (+x).
glm::dvec3 citadel_point(double turns, double radius, double y);

// 760 x 760 m of 5 m cells: level on the hill's top (38 m) and under the ring wall (13 m), fields that reach
// down to -4 m exactly.
HeightField make_citadel_ground(uint32_t seed);
void build_ground(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground);

constexpr double kWallRadius = 105;  // m, of the corners of the ring wall's middle line
constexpr double kWallFoot = 13, kWallWalk = 21;
constexpr double kKeepRoof = 46, kKeepHalf = 12, kSpireTop = 96;
void build_ring_wall(MeshBuilder& mesh, const CitadelMaterials& materials);
void build_keep(MeshBuilder& mesh, const CitadelMaterials& materials);

// Ring streets at these radii cross eight straight ones; the houses stand between.
constexpr double kOuterStreet = 87.5, kMiddleStreet = 65.5, kInnerStreet = 43;
constexpr int kStraightStreets = 8;
// Returns the number of houses.
int build_town(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground,
               Random& random);

// Each with a house, a barn and a rick; returns where they stand. Nothing is built within some metres of the
// points of `keep_clear`, here and below.
std::vector<glm::dvec2> build_farms(MeshBuilder& mesh, const CitadelMaterials& materials,
                                    const HeightField& ground, Random& random,
                                    const std::vector<glm::dvec3>& keep_clear);
void build_conifers(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground,
                    Random& random, const std::vector<glm::dvec3>& keep_clear,
                    const std::vector<glm::dvec2>& farms);

}  // namespace ml
