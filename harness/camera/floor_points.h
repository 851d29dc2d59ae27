// Places in an unknown level where a visitor can stand.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/scene/ray_caster.h"
#include "harness/scene/scene.h"

namespace ml {

// How large the visitor is, as a factor of a grown person; everything below scales with it.
struct Stature {
  double scale = 1;
  double eye() const { return 1.7 * scale; }         // m above the floor
  double headroom() const { return 0.3 * scale; }    // m free above the eye
  double clearance() const { return 0.45 * scale; }  // m free around the eye
};

struct FloorPoint {
  glm::dvec3 eye;
  double openness = 0;  // m, mean free length of level views
};

// Eye positions over near-horizontal surfaces of either winding, with room to stand, in a fixed order.
// walled: with walls around, not on the roof over another floor, not within a solid; empty when the level
// offers too few of them. any: on the ground rather than on a roof, but with nothing around if need be.
enum class FloorKind { walled, any };
std::vector<FloorPoint> find_floor_points(const RayCaster& rays, const Bounds& bounds, uint32_t seed,
                                          const Stature& stature, FloorKind kind);

}  // namespace ml
