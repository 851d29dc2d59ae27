// The oracle's tolerance: no false alarm, however unlucky a device rounds within what Vulkan allows it, and
// no error hidden at an ordinary point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/accuracy/oracle.h"
#include "harness/base/random.h"

namespace {

using namespace ml;
using glm::dvec3;
using glm::vec3;

// Single precision as a device may have it: every result is off by up to so many ulp, by lot.
class Device {
 public:
  Device(uint32_t seed, bool unlucky) : random_(seed), unlucky_(unlucky) {}
  float rounded(float exact, float ulps) {
    if (!unlucky_) return exact;
    const float ulp = std::nextafter(std::abs(exact), INFINITY) - std::abs(exact);
    return exact + std::round(ulps * random_.uniform(-1, 1)) * ulp;
  }
  float divide(float a, float b) { return rounded(a / b, 2.5f); }
  float root(float x) { return rounded(std::sqrt(x), 3); }
  vec3 normalized(const vec3& v) {
    const float inverse = rounded(1 / std::sqrt(glm::dot(v, v)), 2);
    return v * inverse;
  }

 private:
  Random random_;
  bool unlucky_;
};

struct FloatSum {
  dvec3 radiance{0};
  uint32_t contributing = 0;
};

// Window of a box along one axis; 0 outside.
float slab(Device& device, const vec3& axis, float extent, const vec3& offset) {
  const float coordinate = glm::dot(offset, axis),
              ratio = device.divide(coordinate * coordinate, extent * extent);
  return ratio < 1 ? 1 - ratio * ratio : 0;
}

// One light as the shaders' definition has it (harness/scene/light.h), step by step in single precision.
FloatSum shade_in_single(const SurfacePoint& point, const OracleLight& light, const vec3& to_eye,
                         Device& device) {
  const vec3 normal = device.normalized(vec3(point.normal)), side(light.side), axis(light.direction);
  vec3 offset = vec3(light.position) - vec3(point.position);
  if (light.half_length > 0) {
    const float limit = static_cast<float>(light.half_length);
    offset += std::clamp(-glm::dot(offset, side), -limit, limit) * side;
  }
  const float squared = glm::dot(offset, offset);
  float window = 1;
  if (light.box) {
    const vec3 axes[] = {side, glm::cross(axis, side), axis};
    for (int i = 0; i < 3; ++i)
      window *= slab(device, axes[i], static_cast<float>(light.half_extents[i]), offset);
  } else {
    const float ratio = device.divide(squared, static_cast<float>(light.radius * light.radius));
    window = ratio < 1 ? 1 - ratio * ratio : 0;
  }
  if (!(window > 0)) return {};
  vec3 direction = normal;
  float cosine = 1;
  if (!(squared < 1e-12f)) {
    const float projected = glm::dot(offset, normal), inverse = device.divide(1, device.root(squared));
    if (!light.probe && !(projected > 0)) return {};
    direction = offset * inverse;
    cosine = light.probe ? 1 : std::min(projected * inverse, 1.0f);
  }
  float strength = light.probe ? window * window : device.divide(window * window, std::max(squared, 1e-4f));
  if (light.spot) {
    const vec3 chord = direction + axis;
    const float aside = 0.5f * glm::dot(chord, chord);
    const float cone =
        std::min((static_cast<float>(light.cone_limit) - aside) * static_cast<float>(light.cone_scale), 1.0f);
    if (!(cone > 0)) return {};
    strength *= cone * cone;
  }
  const float metallic = static_cast<float>(point.metallic);
  vec3 brdf = vec3(point.albedo) * ((1 - metallic) * static_cast<float>(1 / std::numbers::pi));
  const vec3 between = direction + to_eye;
  if (!light.probe && glm::dot(between, between) > 1e-12f) {
    const vec3 half = between / device.root(glm::dot(between, between));
    const float rough = std::max(static_cast<float>(point.roughness), 0.045f),
                a2 = rough * rough * rough * rough;
    const float nv = std::clamp(std::abs(glm::dot(normal, to_eye)), 1e-4f, 1.0f);
    const float nh = std::clamp(glm::dot(normal, half), 0.0f, 1.0f);
    const float vh = std::clamp(glm::dot(to_eye, half), 0.0f, 1.0f);
    const vec3 aside = glm::cross(normal, half);
    const float spread = nh * nh * a2 + glm::dot(aside, aside);
    const float lobe = device.divide(a2, static_cast<float>(std::numbers::pi) * spread * spread) *
                       device.divide(0.5f, cosine * device.root(nv * nv * (1 - a2) + a2) +
                                               nv * device.root(cosine * cosine * (1 - a2) + a2));
    const vec3 f0 = glm::mix(vec3(0.04f), vec3(point.albedo), metallic);
    const float away = 1 - vh, grazing = away * away * away * away * away;
    brdf += (f0 + (1.0f - f0) * grazing) * lobe;
  }
  return {dvec3(vec3(light.intensity) * brdf * (strength * cosine)), 1};
}

dvec3 random_direction(Random& random) {
  const double z = 2.0 * random.uniform() - 1, angle = 2 * std::numbers::pi * random.uniform();
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

// Through memory: gcc 12 leaves out the rounding of two of the three where it makes vectors of them.
dvec3 in_single(const dvec3& v) {
  const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
  return {x, y, z};
}

// A point as a g-buffer has it, 0.1 m to 500 m away.
SurfacePoint random_point(Random& random) {
  SurfacePoint point;
  point.position = in_single(0.1 * std::pow(5000.0, double{random.uniform()}) * random_direction(random));
  point.normal = glm::normalize(in_single(random_direction(random)));
  // Interpolated normals may face away from the viewer, but few do.
  if (glm::dot(point.normal, point.position) > 0 && random.below(20) != 0) point.normal = -point.normal;
  point.albedo = in_single({random.uniform(), random.uniform(), random.uniform()});
  point.roughness = static_cast<float>(random.below(256)) / 255;
  point.metallic = static_cast<float>(random.below(2) ? random.below(256) : 0) / 255;
  return point;
}

// A light that shines on the point from where nothing is delicate: a metre to ten metres away, not from
// the horizon, the point neither at the edge of its volume nor in a narrow cone.
OracleLight ordinary_light(Random& random, const SurfacePoint& point) {
  OracleLight light;
  dvec3 to_light = random_direction(random);
  while (glm::dot(to_light, point.normal) < 0.2) to_light = random_direction(random);
  const double distance = std::pow(10.0, double{random.uniform()});
  light.position = in_single(point.position + distance * to_light);
  light.radius = static_cast<float>(distance * (1.3 + 3 * random.uniform()));
  light.intensity = in_single(distance * distance * dvec3(1, 0.5, 2));
  if (random.below(3) == 0) {
    light.spot = true;
    light.direction = glm::normalize(in_single(glm::normalize(-to_light + 0.3 * random_direction(random))));
    light.cone_limit = 0.5;
    light.cone_scale = 4;
  }
  return light;
}

// A light of any shape whose source is `distance` away from the point. `edge`: it ends near the point, in one
// way or another.
OracleLight random_light(Random& random, const SurfacePoint& point, bool edge) {
  const double distance = 0.01 * std::pow(3000.0, double{random.uniform()});
  const double nearly = 1 + (random.uniform() - 0.5) * std::pow(10.0, -7.0 * random.uniform());
  dvec3 to_light = random_direction(random);
  if (glm::dot(to_light, point.normal) < 0) to_light = -to_light;
  OracleLight light;
  if (edge && random.below(4) == 0)
    to_light = glm::normalize(to_light - glm::dot(to_light, point.normal) * point.normal * nearly);
  light.position = in_single(point.position + distance * to_light);
  light.radius =
      static_cast<float>(distance * (edge && random.below(3) == 0 ? nearly : 1.1 + 3 * random.uniform()));
  light.intensity = in_single(distance * distance * dvec3(1, 0.5, 2));
  light.probe = random.below(5) == 0;
  const dvec3 direction =
      glm::normalize(in_single(glm::normalize(-to_light + 0.4 * random_direction(random))));
  const dvec3 side = in_single(glm::normalize(glm::cross(direction, random_direction(random))));
  const uint32_t shape = random.below(5);
  if (shape == 1 || shape == 3) {
    light.spot = true;
    light.direction = direction;
    const double off_axis = 1 + glm::dot(direction, to_light);
    light.cone_limit = static_cast<float>(edge ? off_axis * nearly : off_axis * (1.5 + random.uniform()));
    light.cone_scale =
        static_cast<float>(edge && random.below(2) ? 1e6 : 1 / (light.cone_limit * random.uniform() + 1e-6));
  }
  if (shape == 2 || shape == 3) {
    light.side = side;
    light.half_length = static_cast<float>(distance * random.uniform() * 5);
  }
  if (shape == 4) {
    light.box = true;
    light.direction = in_single(direction);
    light.side = side;
    const dvec3 from = point.position - light.position;
    const dvec3 position{glm::dot(from, side), glm::dot(from, glm::cross(light.direction, side)),
                         glm::dot(from, light.direction)};
    const bool face = edge && random.below(2) == 0;
    for (int axis = 0; axis < 3; ++axis)
      light.half_extents[axis] =
          static_cast<float>(std::abs(position[axis]) * (axis == 1 && face ? nearly : 1.2) + 1e-3);
    light.radius = glm::length(light.half_extents);
  }
  return light;
}

vec3 eye_of(const SurfacePoint& point, Device& device) {
  return -device.normalized(vec3(point.position));
}

double largest_ratio(const dvec3& value, const OracleAnswer& answer) {
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel)
    worst = std::max(worst, std::abs(value[channel] - answer.radiance[channel]) / answer.tolerance[channel]);
  return worst;
}

TEST(Rounding, RaisesNoFalseAlarmAtEdgesAndElsewhere) {
  Random random(1);
  double worst = 0;
  uint32_t contributing = 0, switched = 0;
  for (uint32_t number = 0; number < 300'000; ++number) {
    const SurfacePoint point = random_point(random);
    ASSERT_EQ(point.position, in_single(point.position));
    const OracleLight light = random_light(random, point, number % 2 == 0);
    Device device(number, number % 4 < 2);
    const OracleAnswer answer = oracle_shade(point, std::span(&light, 1), true);
    const FloatSum sum = shade_in_single(point, light, eye_of(point, device), device);
    const double ratio = largest_ratio(sum.radiance, answer);
    ASSERT_LE(ratio, 1) << "case " << number << ": " << sum.radiance.x << " for " << answer.radiance.x
                        << " +- " << answer.tolerance.x;
    worst = std::max(worst, ratio);
    contributing += sum.contributing;
    if (sum.contributing == answer.contributing) continue;
    ASSERT_EQ(answer.marginal, 1u) << "case " << number;
    ++switched;
  }
  RecordProperty("largest_ratio", std::to_string(worst));
  EXPECT_GT(contributing, 150'000u);
  EXPECT_GT(switched, 20u) << "no case was near enough to an edge";
}

TEST(Rounding, OfASumGrowsWithItsLights) {
  Random random(2);
  for (uint32_t count : {1u, 30u, 1000u, 20'000u}) {
    const SurfacePoint point = random_point(random);
    std::vector<OracleLight> lights;
    for (uint32_t i = 0; i < count; ++i) lights.push_back(random_light(random, point, false));
    Device device(count, true);
    vec3 sum(0);
    for (const OracleLight& light : lights)
      sum += vec3(shade_in_single(point, light, eye_of(point, device), device).radiance);
    EXPECT_LE(largest_ratio(dvec3(sum), oracle_shade(point, lights, true)), 1) << count;
  }
}

// One light of seven is a ten-thousandth too strong.
TEST(Rounding, HidesNoErrorAtAnOrdinaryPoint) {
  Random random(3);
  uint32_t cases = 0;
  for (uint32_t number = 0; number < 40'000; ++number) {
    SurfacePoint point = random_point(random);
    point.roughness = std::max(point.roughness, 0.4);
    const double cosine = -glm::dot(point.normal, point.position) / glm::length(point.position);
    if (glm::length(point.position) > 20 || cosine < 0.2) continue;
    std::vector<OracleLight> lights;
    for (uint32_t i = 0; i < 7; ++i) lights.push_back(ordinary_light(random, point));
    Device device(number, true);
    dvec3 right(0), wrong(0);
    double share = 0;
    for (const OracleLight& light : lights) {
      const dvec3 one = shade_in_single(point, light, eye_of(point, device), device).radiance;
      right += one;
      wrong += &light == &lights[3] ? one * (1 + 1e-4) : one;
      if (&light == &lights[3]) share = one.x;
    }
    const OracleAnswer answer = oracle_shade(point, lights, true);
    EXPECT_LE(largest_ratio(right, answer), 1);
    if (share < 0.4 * right.x) continue;  // it must be seen among the others
    ++cases;
    EXPECT_GT(largest_ratio(wrong, answer), 1) << number << ": " << answer.tolerance.x / answer.radiance.x;
  }
  EXPECT_GT(cases, 300u);
}

}  // namespace
