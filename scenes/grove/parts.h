// The parts of the grove: ground, the winding way and what stands along it, trees. The way runs along z
// through x = z = 0; y is up.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/height_field.h"
#include "harness/scene/mesh_builder.h"

namespace ml {

struct GroveMaterials {
  uint32_t grass, earth, picket, timber, iron, lamp, bark;
  uint32_t leaves[3];
};

HeightField make_grove_ground(uint32_t seed);

// The way's middle line, by length.
class GroveWay {
 public:
  GroveWay();
  double length() const { return steps_.back().length; }  // m

  struct WayPoint {
    glm::dvec2 point;  // x, z in m
    glm::dvec2 ahead;  // unit length
    // `across` m to the right.
    glm::dvec2 beside(double across) const { return point + across * glm::dvec2(-ahead.y, ahead.x); }
  };
  WayPoint at(double length) const;
  // m from the nearest point of the middle line, at most 0.4 m too many.
  double distance(const glm::dvec2& point) const;

 private:
  struct Step {
    double length;  // m of way before
    glm::dvec2 point;
  };
  std::vector<Step> steps_;
};

void build_ground(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                  const GroveWay& way);

constexpr double kFenceOffset = 1.7;  // m from the middle line
constexpr int kSlats = 1500;          // on each side
void build_fences(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                  const GroveWay& way);
// Every 12 m, left and right in turn.
void build_lamps(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                 const GroveWay& way);

// None within some metres of the points of `keep_clear`.
void build_trees(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                 const GroveWay& way, Random& random, const std::vector<glm::dvec3>& keep_clear);

}  // namespace ml
