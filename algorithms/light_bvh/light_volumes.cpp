#include "algorithms/light_bvh/light_volumes.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

// The shader compares cosines, and a narrow cone's edge is where they differ little (as
// algorithms/froxels/shape_bounds.cpp).
constexpr double cosine_error = 4e-6;
// m: so near the apex a light has no direction, and gives as along its axis (harness/scene/light.h).
constexpr double apex = 1e-6;

// In double precision.
struct Reach {
  glm::dvec3 center;        // of the ball
  double radius;            // m
  glm::dvec3 below, above;  // m from the light's position, along the world axes, >= 0
};

// How far a cone's sector of the unit ball reaches along a unit vector that has this component along its
// axis.
double sector_reach(double along, double cosine, double sine) {
  if (along >= cosine) return 1;
  return std::max(along * cosine + std::sqrt(std::max(1 - along * along, 0.0)) * sine, 0.0);
}

double cosine_of(const gpu_data::LightExtra& extra) {
  return std::max(static_cast<double>(extra.cos_outer) - cosine_error, -1.0);
}

double sine_of(const gpu_data::LightExtra& extra) {
  const double cosine = cosine_of(extra);
  return std::sqrt(std::max(1 - cosine * cosine, 0.0));
}

Reach cone_reach(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra) {
  const glm::dvec3 position(core.position), direction(extra.direction);
  const auto radius = static_cast<double>(core.radius);
  const double cosine = cosine_of(extra), sine = sine_of(extra);
  Reach reach{position, radius, {}, {}};
  if (cosine > 0) {
    // Through the apex and the rim; wider than 45 degrees, around the rim.
    const bool narrow = cosine > sine;
    const double ahead = narrow ? 0.5 * radius / cosine : radius * cosine;
    reach.center += direction * ahead;
    reach.radius = narrow ? ahead : radius * sine;
  }
  for (int axis = 0; axis < 3; ++axis) {
    reach.above[axis] = radius * sector_reach(direction[axis], cosine, sine);
    reach.below[axis] = radius * sector_reach(-direction[axis], cosine, sine);
  }
  return reach;
}

Reach reach_of(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra) {
  const uint32_t shape = core.id_shape >> 24;
  const glm::dvec3 side(extra.side), center(core.position);
  if (shape == ML_SHAPE_BOX) {
    const glm::dvec3 half(gpu_data::box_half_extents(extra));
    const glm::dvec3 extents = glm::abs(side) * half.x +
                               glm::abs(glm::dvec3(gpu_data::box_up(extra))) * half.y +
                               glm::abs(glm::dvec3(extra.direction)) * half.z;
    return {center, static_cast<double>(extra.bound_radius), extents, extents};
  }
  const bool cone = shape == ML_SHAPE_SPOT || shape == ML_SHAPE_WEDGE;
  const glm::dvec3 all(static_cast<double>(core.radius));
  Reach reach = cone ? cone_reach(core, extra) : Reach{center, all.x, all, all};
  // Swept along the segment that is the source. A point of the sector is no further than the ball's radius
  // from its middle and `across` of that along the segment.
  const auto length = static_cast<double>(extra.half_length);
  const double across =
      cone ? std::min(reach.radius, all.x * sector_reach(0, cosine_of(extra), sine_of(extra))) : reach.radius;
  reach.radius = std::sqrt(reach.radius * reach.radius + length * (length + 2 * across));
  reach.below += glm::abs(side) * length;
  reach.above += glm::abs(side) * length;
  return reach;
}

}  // namespace

LightVolume volume_of(const FrameLights& lights, uint32_t light) {
  const glm::vec3 position(lights.x[light], lights.y[light], lights.z[light]);
  if (lights.extra.empty() || lights.core[light].id_shape >> 24 == ML_SHAPE_OMNI) {
    const float radius = widened(position, static_cast<double>(lights.radius[light]));
    return {position, radius, {position - radius, position + radius}};
  }
  const Reach reach = reach_of(lights.core[light], lights.extra[light]);
  LightVolume volume{glm::vec3(reach.center), widened(position, reach.radius + 2 * apex), {}};
  const auto whole = static_cast<double>(lights.radius[light]);
  const double margin = static_cast<double>(widened(position, whole + 2 * apex)) - whole;
  volume.box = {glm::vec3(glm::dvec3(position) - reach.below - margin),
                glm::vec3(glm::dvec3(position) + reach.above + margin)};
  return volume;
}

void find_volumes(const FrameLights& lights, std::vector<LightVolume>& volumes) {
  volumes.resize(lights.count());
  for (size_t i = 0; i < lights.count(); ++i) volumes[i] = volume_of(lights, static_cast<uint32_t>(i));
}

}  // namespace ml
