#include "harness/lights/positions.h"

#include "harness/lights/stage.h"

namespace ml {
namespace {

// m, from the walls, floor and ceiling of a room: lights closer to them would leave the far half of it dark.
constexpr double kFromWalls = 2.5;

// Where lights of placement `room` stand; a room without the space for the distance keeps its middle half.
Bounds within(const Bounds& room) {
  glm::vec3 margin = glm::min(glm::vec3(kFromWalls), 0.25f * room.size());
  return {room.min + margin, room.max - margin};
}

}  // namespace

LightPositions::LightPositions(const LightSpec& spec, const Scene& scene)
    : seed_hash_(hash_u32(spec.seed)), height_(spec.height) {
  const Placement placement = *spec.placement;
  const Bounds box = placement == Placement::room ? within(rooms_of(scene, placement).front()) : scene.bounds;
  corner_ = glm::dvec3(box.min);
  extent_ = glm::dvec3(box.max) - corner_;
  if (placement == Placement::clumps) clumps_.emplace(scene, seed_hash_);
  if (placement == Placement::triangle || placement == Placement::area)
    surface_.emplace(scene, placement == Placement::area);
}

glm::dvec3 LightPositions::at(uint32_t light, double radius) const {
  if (clumps_) return clumps_->at(light, radius);
  LightNumbers number(seed_hash_, light);
  glm::dvec3 choice(number(LightDimension::position_0), number(LightDimension::position_1),
                    number(LightDimension::position_2));
  if (!surface_) return corner_ + extent_ * choice;
  SurfaceSampler::Point point = surface_->at(choice.x, choice.y, choice.z);
  double lift = height_ > 0 ? height_ : 0.5 * radius * number(LightDimension::lift);
  return point.position + lift * point.normal;
}

}  // namespace ml
