#include "harness/lights/clumps.h"

#include <algorithm>
#include <cmath>

#include "harness/lights/radius_distribution.h"

namespace ml {
namespace {

constexpr double kClumpedShare = 0.6;
constexpr double kSpread = 2.5, kRise = 0.75, kMiddle = 1.5;  // m
constexpr double kLowest = 0.1;                               // m above the clump's foot
constexpr uint32_t kMiddles = 41, kMembers = 42;              // streams of random numbers

struct Knot {
  double count, smallest, ratio;  // m
};
constexpr std::array<Knot, 3> kKnots{{{50, 4, 4}, {500, 2, 4}, {3240, 0.8, 6}}};
constexpr double kFlatExtent = 90.0 * 90.0;  // m^2, of the level the radii are for

// On the straight line between two knots over the logarithms.
double between_knots(double count, double Knot::*value) {
  if (count <= kKnots.front().count) return kKnots.front().*value;
  for (size_t i = 0; i + 1 < kKnots.size(); ++i) {
    const Knot &a = kKnots[i], &b = kKnots[i + 1];
    if (count > b.count) continue;
    double share = std::log(count / a.count) / std::log(b.count / a.count);
    return a.*value * std::pow(b.*value / a.*value, share);
  }
  return kKnots.back().*value;
}

// Whatever the last bits of log() and pow() are here.
double rounded(double value) {
  return std::floor(value * 1e4 + 0.5) / 1e4;
}

// Standard normal but for the tails (none beyond 4.2): the sum of six uniform numbers.
double normal_number(Random& random) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += static_cast<double>(random.uniform());
  return (sum - 3) * 1.4142135623730951;
}

}  // namespace

std::optional<uint32_t> clump_of(const LightNumbers& number) {
  double choice = static_cast<double>(number(LightDimension::clump)) / kClumpedShare;
  if (choice >= 1) return std::nullopt;
  return std::min(static_cast<uint32_t>(choice * kClumps), kClumps - 1);
}

double clump_smallest_radius(uint32_t count, const Scene& scene) {
  double smallest = between_knots(count, &Knot::smallest);
  double beyond = kKnots.back().count / std::max<double>(count, 1);
  if (beyond < 1) smallest *= std::sqrt(beyond);
  glm::dvec3 size(scene.bounds.size());
  double flat = size.x * size.z;
  // A level that stands upright: the sides of its walls count as one.
  if (!(flat > 0)) flat = 0.5 * surface_area(scene);
  return flat > 0 ? rounded(smallest) * std::sqrt(flat / kFlatExtent) : smallest;
}

float clump_radius_ratio(uint32_t count) {
  return static_cast<float>(rounded(between_knots(count, &Knot::ratio)));
}

ClumpSampler::ClumpSampler(const Scene& scene, uint32_t seed_hash)
    : surface_(scene, true), seed_hash_(seed_hash) {
  for (uint32_t clump = 0; clump < kClumps; ++clump) {
    Random random(hash_u32(seed_hash, kMiddles, clump));
    feet_[clump] = floor_point(random).position;
  }
}

// The last try stands in a level where next to nothing faces up.
SurfaceSampler::Point ClumpSampler::floor_point(Random& random) const {
  SurfaceSampler::Point point;
  for (int tries = 0; tries < 64; ++tries) {
    double choice = random.uniform(), u = random.uniform(), v = random.uniform();
    point = surface_.at(choice, u, v);
    if (point.normal.y > 0.5) break;
  }
  return point;
}

glm::dvec3 ClumpSampler::at(uint32_t light, double radius) const {
  Random random(hash_u32(seed_hash_, kMembers, light));
  std::optional<uint32_t> clump = clump_of(LightNumbers(seed_hash_, light));
  if (!clump) {
    SurfaceSampler::Point point = floor_point(random);
    return point.position + 0.5 * radius * static_cast<double>(random.uniform()) * point.normal;
  }
  double x = normal_number(random), y = normal_number(random), z = normal_number(random);
  return feet_[*clump] + glm::dvec3(kSpread * x, std::max(kMiddle + kRise * y, kLowest), kSpread * z);
}

}  // namespace ml
