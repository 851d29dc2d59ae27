#include "harness/accuracy/rounding.h"

#include <cmath>
#include <numbers>

namespace ml {
namespace {

constexpr double u = rounding_unit;
constexpr double coincident = 1e-6;     // m, nearer a light has no direction
constexpr double least_squared = 1e-4;  // m^2, of the inverse square
constexpr double any_direction = 2;     // longest chord between two unit vectors
constexpr double normal_error = 3 * u;  // rad, of unpacking and normalizing it
constexpr double viewer_error = 2 * u;  // rad

double squared(double x) {
  return x * x;
}

// 1 - (l/h)^4 for l in `coordinate`, which is not negative.
Range edge_window(const Range& coordinate, double extent) {
  const double low = squared(coordinate.low / extent) * (1 - 8 * u),
               high = squared(coordinate.high / extent) * (1 + 8 * u);
  return {std::max(0.0, 1 - squared(high) - 2 * u), std::clamp(1 - squared(low) + 2 * u, 0.0, 1.0)};
}

Range box_window(const OracleLight& light, const glm::dvec3& from_centre, double error) {
  const glm::dvec3 axes[] = {light.side, glm::cross(light.direction, light.side), light.direction};
  Range window{1, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = std::abs(glm::dot(from_centre, axes[axis])), extent = light.half_extents[axis];
    if (!(extent > 0)) return {};
    window = (window * edge_window(Range::around(coordinate, error, 0, coordinate + error), extent))
                 .widened(2 * u);
    if (coordinate - error >= extent) window = {};
  }
  return window;
}

}  // namespace

SourceSight see_source(const SurfacePoint& point, const OracleLight& light, const glm::dvec3& from_centre,
                       double along) {
  const glm::dvec3 offset = light.side * along - from_centre;
  SourceSight sight;
  sight.distance = glm::length(offset);
  // The point's coordinates come from its depth; their differences from the light's are rounded, and so is
  // the foot on a segment, which is found by products of the longer vector.
  const glm::dvec3 magnitude = glm::abs(point.position);
  const double whole = glm::length(from_centre) + std::abs(along);
  sight.distance_error =
      u * std::max({magnitude.x, magnitude.y, magnitude.z}) + (light.half_length > 0 ? 8 : 1) * u * whole;
  const bool touching = sight.distance < coincident;
  sight.to_light = touching ? point.normal : offset / sight.distance;
  sight.rotation = touching ? normal_error : sight.distance_error / sight.distance + 2 * u;
  if (std::abs(sight.distance - coincident) <= sight.distance_error) sight.rotation = any_direction;
  sight.rotation = std::min(sight.rotation, any_direction);
  if (touching) sight.distance = 0;
  return sight;
}

Range window_range(const SourceSight& sight, const OracleLight& light, const glm::dvec3& from_centre) {
  if (light.box)
    return box_window(light, from_centre, sight.distance_error + 8 * u * glm::length(from_centre));
  const double error = sight.distance_error + 3 * u * sight.distance;
  const Range distance = Range::around(sight.distance, error, 0, sight.distance + error);
  if (!(distance.low < light.radius)) return {};
  return edge_window(distance, light.radius);
}

Range inverse_square_range(const SourceSight& sight) {
  const double error = sight.distance_error;
  const double near = std::max(0.0, sight.distance - error), far = sight.distance + error;
  return Range{1 / std::max(squared(far), least_squared), 1 / std::max(squared(near), least_squared)}.widened(
      8 * u);
}

Range cone_range(const SourceSight& sight, const OracleLight& light, double off_axis) {
  if (!light.spot) return {1, 1};
  // As half the square of the chord between the two directions.
  const double chord = std::sqrt(2 * std::max(0.0, off_axis)), chord_error = sight.rotation + 4 * u;
  const double error = chord * chord_error + 0.5 * squared(chord_error) + 4 * stretch * off_axis;
  const double factor = (light.cone_limit - off_axis) * light.cone_scale;
  return Range::around(factor, light.cone_scale * error + 4 * u * std::abs(factor), 0, 1);
}

Range facing_range(const SourceSight& sight, double cosine) {
  return Range::around(cosine, sight.rotation + normal_error + 4 * u + stretch * std::abs(cosine), 0, 1);
}

HighlightRange highlight_range(const SurfacePoint& point, const SourceSight& sight,
                               const glm::dvec3& to_viewer, const Range& facing) {
  const glm::dvec3 sum = sight.to_light + to_viewer;
  const double length = glm::length(sum), sum_error = sight.rotation + viewer_error + 2 * stretch;
  const double rotation = length > 0 ? std::min(sum_error / length + 4 * u, any_direction) : any_direction;
  const glm::dvec3 half = length > 0 ? sum / length : point.normal;

  const double rough = std::max(point.roughness, 0.045), alpha2 = squared(squared(rough));
  const Range sine =
      Range::around(glm::length(glm::cross(point.normal, half)), rotation + normal_error + 4 * u, 0, 1);
  const Range cosine = Range::around(glm::dot(point.normal, half), rotation + normal_error + 4 * u, 0, 1);
  const Range spread = alpha2 * (cosine * cosine) + sine * sine;
  auto distribution = [&](double lobe) { return alpha2 / (std::numbers::pi * squared(lobe)); };
  const Range viewed = Range::around(std::abs(glm::dot(point.normal, to_viewer)),
                                     viewer_error + normal_error + stretch, 1e-4, 1);
  auto visibility = [&](double nl, double nv) {
    return 0.5 / (nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) +
                  nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
  };
  const Range aslant =
      Range::around(1 - std::clamp(glm::dot(to_viewer, half), 0.0, 1.0), rotation + viewer_error, 0, 1);

  HighlightRange range;
  range.lobe = (Range{distribution(spread.high), distribution(spread.low)} *
                Range{visibility(facing.high, viewed.high), visibility(facing.low, viewed.low)})
                   .widened(40 * u);
  range.grazing = Range{std::pow(aslant.low, 5), std::pow(aslant.high, 5)}.widened(8 * u);
  // Without a half vector there is no highlight.
  if (length <= sum_error + 2e-6) range.lobe.low = 0;
  return range;
}

}  // namespace ml
