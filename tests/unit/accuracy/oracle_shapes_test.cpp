// Properties of segments, wedges and boxes in the double-precision oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/accuracy/oracle.h"
#include "harness/base/random.h"

namespace {

using namespace ml;
using glm::dvec3;

dvec3 random_direction(Random& random) {
  double z = 2.0 * random.uniform() - 1, angle = 2 * std::numbers::pi * random.uniform();
  double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

dvec3 across(const dvec3& direction, Random& random) {
  return glm::normalize(glm::cross(direction, random_direction(random)));
}

SurfacePoint random_point(Random& random) {
  return {.position = 4.0 * random.uniform() * random_direction(random) + dvec3(0, 0, -10),
          .normal = random_direction(random),
          .roughness = random.uniform()};
}

enum class Kind { capsule, wedge, box };

OracleLight random_light(Kind kind, Random& random) {
  OracleLight light{.position = 3.0 * random.uniform() * random_direction(random) + dvec3(0, 0, -10),
                    .radius = 0.5 + 3 * random.uniform(),
                    .direction = random_direction(random)};
  light.side = across(light.direction, random);
  if (kind == Kind::box) {
    light.box = true;
    light.half_extents = {0.3 + 2 * random.uniform(), 0.3 + 2 * random.uniform(), 0.3 + 2 * random.uniform()};
    light.radius = glm::length(light.half_extents);
    return light;
  }
  light.half_length = 3 * random.uniform();
  if (kind == Kind::capsule) return light;
  light.spot = true;
  light.cone_limit = 1.9 - 1.8 * random.uniform();
  light.cone_scale = 2 / light.cone_limit;
  return light;
}

OracleAnswer shade(const SurfacePoint& point, const OracleLight& light, bool specular = true) {
  return oracle_shade(point, std::span(&light, 1), specular);
}

void expect_equal(const OracleAnswer& a, const OracleAnswer& b, double tolerance = 0) {
  EXPECT_EQ(a.contributing, b.contributing);
  EXPECT_EQ(a.marginal, b.marginal);
  EXPECT_LE(glm::length(a.radiance - b.radiance), tolerance * glm::length(a.radiance));
}

TEST(OracleProbes, GiveTheirWindowToEverySurfaceInTheirVolumeAndOnlyDiffusely) {
  Random random(21);
  uint32_t lit = 0;
  for (int number = 0; number < 3000; ++number) {
    OracleLight light = random_light(static_cast<Kind>(random.below(3)), random);
    light.probe = true;
    SurfacePoint point = random_point(random);
    point.metallic = random.below(2) ? 0.25 : 1.0;
    const OracleAnswer answer = shade(point, light);
    // Whichever way the surface faces, with and without highlights.
    SurfacePoint turned = point;
    turned.normal = random_direction(random);
    expect_equal(answer, shade(turned, light));
    expect_equal(answer, shade(point, light, false));
    // In the volume, and nowhere else: as for the direct light on a surface that faces it.
    const dvec3 from = point.position - light.position;
    const double along = std::clamp(glm::dot(from, light.side), -light.half_length, light.half_length);
    const dvec3 offset = light.side * along - from;
    SurfacePoint facing = point;
    facing.normal = glm::normalize(offset);
    OracleLight direct = light;
    direct.probe = false;
    const OracleAnswer seen = shade(facing, direct, false);
    EXPECT_EQ(answer.contributing, seen.contributing);
    // It is that light without the inverse square.
    const double squared = std::max(glm::dot(offset, offset), 1e-4);
    EXPECT_LE(glm::length(answer.radiance - seen.radiance * squared), 1e-9 * glm::length(answer.radiance));
    lit += answer.contributing;
  }
  EXPECT_GT(lit, 300u);
}

TEST(OracleShapes, WithoutALengthTheyAreOmniLightsAndSpots) {
  Random random(1);
  uint32_t contributing = 0;
  for (int i = 0; i < 20000; ++i) {
    OracleLight light = random_light(i % 2 ? Kind::capsule : Kind::wedge, random);
    light.half_length = 0;
    OracleLight plain = light;
    plain.side = dvec3(1, 0, 0);
    if (!light.spot) plain.direction = dvec3(0, -1, 0);
    const SurfacePoint point = random_point(random);
    expect_equal(shade(point, light), shade(point, plain));
    contributing += shade(point, light).contributing;
  }
  EXPECT_GT(contributing, 1000u);
}

TEST(OracleShapes, SideMayPointEitherWay) {
  Random random(2);
  uint32_t contributing = 0;
  for (int i = 0; i < 20000; ++i) {
    OracleLight light = random_light(static_cast<Kind>(i % 3), random), mirrored = light;
    mirrored.side = -light.side;
    const SurfacePoint point = random_point(random);
    expect_equal(shade(point, light), shade(point, mirrored), 1e-12);
    contributing += shade(point, light).contributing;
  }
  EXPECT_GT(contributing, 1000u);
}

TEST(OracleShapes, ASegmentIsTheNearestOfTheOmniLightsOnIt) {
  // Of many omni lights along it, the nearest one: found by trying, not by a formula.
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    OracleLight capsule = random_light(Kind::capsule, random);
    const SurfacePoint point = random_point(random);
    const OracleAnswer whole = shade(point, capsule, false);
    double nearest = 1e9;
    OracleLight best = capsule;
    for (int k = 0; k <= 20000; ++k) {
      OracleLight part = capsule;
      part.half_length = 0;
      part.position = capsule.position + capsule.side * (capsule.half_length * (k / 10000.0 - 1));
      const double distance = glm::length(part.position - point.position);
      if (distance < nearest) nearest = distance, best = part;
    }
    if (whole.marginal) continue;
    const OracleAnswer one = shade(point, best, false);
    if (one.marginal) continue;
    EXPECT_EQ(whole.contributing, one.contributing);
    // The points are up to 3e-4 m apart, which turns the direction that much over the distance.
    const double turned = oracle_falloff(nearest, capsule.radius) * 3e-4 / nearest;
    EXPECT_LE(glm::length(whole.radiance - one.radiance), 2e-3 * glm::length(whole.radiance) + turned);
  }
}

TEST(OracleShapes, AWedgeIsASpotAtTheNearestPointOfItsSegment) {
  Random random(4);
  uint32_t contributing = 0;
  for (int i = 0; i < 5000; ++i) {
    const OracleLight wedge = random_light(Kind::wedge, random);
    const SurfacePoint point = random_point(random);
    OracleLight spot = wedge;
    spot.half_length = 0;
    const double along = glm::dot(point.position - wedge.position, wedge.side);
    spot.position += wedge.side * glm::clamp(along, -wedge.half_length, wedge.half_length);
    const OracleAnswer a = shade(point, wedge), b = shade(point, spot);
    if (a.marginal || b.marginal) continue;
    expect_equal(a, b, 1e-9);
    contributing += a.contributing;
  }
  EXPECT_GT(contributing, 200u);
}

TEST(OracleShapes, ABoxTurnedWithThePointGivesTheSame) {
  Random random(5);
  uint32_t contributing = 0;
  for (int i = 0; i < 5000; ++i) {
    const OracleLight box = random_light(Kind::box, random);
    SurfacePoint point = random_point(random);
    point.view = random_direction(random);
    const dvec3 up = glm::cross(box.direction, box.side);
    auto local = [&](const dvec3& v) {
      return dvec3(glm::dot(v, box.side), glm::dot(v, up), glm::dot(v, box.direction));
    };
    OracleLight straight = box;
    straight.position = dvec3(0), straight.side = {1, 0, 0}, straight.direction = {0, 0, 1};
    SurfacePoint turned = point;
    turned.position = local(point.position - box.position), turned.normal = local(point.normal);
    turned.view = local(point.view);
    const OracleAnswer a = shade(point, box), b = shade(turned, straight);
    if (a.marginal || b.marginal) continue;
    expect_equal(a, b, 1e-9);
    contributing += a.contributing;
  }
  EXPECT_GT(contributing, 200u);
}

TEST(OracleShapes, AreZeroAtTheirBoundaryAndPositiveWithinIt) {
  // A floor, and lights whose volumes end just above and just below it.
  const SurfacePoint floor{.position = {0, 0, -10}, .normal = {0, 1, 0}, .view = {0, 1, 0}};
  auto contributes = [&](const OracleLight& light) { return shade(floor, light).contributing; };
  for (double slide : {0.0, 1.9, -1.9})
    for (double edge : {1 - 1e-9, 1.0}) {
      OracleLight tube{.position = {slide, 2 * edge, -10}, .radius = 2, .half_length = 2};
      EXPECT_EQ(contributes(tube), edge < 1) << slide;
      tube.spot = true, tube.cone_limit = 2.0 / 3, tube.cone_scale = 1.5;
      EXPECT_EQ(contributes(tube), edge < 1) << "wedge at " << slide;
      OracleLight box{
          .position = {slide, 2 * edge, -10}, .radius = 9, .box = true, .half_extents = {2, 3, 2}};
      EXPECT_EQ(contributes(box), edge < 1) << "direction is down: its extent is the third";
    }
  // Beyond the end of the segment there is the ball around it.
  OracleLight end{.position = {3, 0.5, -10}, .radius = 1.2, .half_length = 2};
  EXPECT_EQ(contributes(end), 1u);
  end.radius = std::sqrt(1.25);
  EXPECT_EQ(contributes(end), 0u);
}

TEST(OracleShapes, BoxFalloffIsZeroFromItsFacesOnAndNeverNotANumber) {
  const dvec3 half{1, 0.25, 4};
  Random random(6);
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      dvec3 position{0.3, 0.1, -0.7};
      position[axis] = sign * half[axis];
      EXPECT_EQ(oracle_box_falloff(position, half), 0);
      position[axis] = sign * std::nextafter(half[axis], 0);
      EXPECT_GT(oracle_box_falloff(position, half), 0);
      dvec3 flat = half;
      flat[axis] = 0;
      EXPECT_EQ(oracle_box_falloff(dvec3(0), flat), 0);
      EXPECT_EQ(oracle_box_falloff(position, flat), 0);
    }
  EXPECT_EQ(oracle_box_falloff(dvec3(std::nan("")), half), 0);
  EXPECT_NEAR(oracle_box_falloff({0.5, 0, 0}, half), 0.9375 * 0.9375 / 0.25, 1e-15);
  EXPECT_NEAR(oracle_box_falloff({0.5, 0.125, 2}, half), std::pow(0.9375, 6) / (0.25 + 0.015625 + 4), 1e-15);
}

TEST(OracleShapes, MarginalLightsAreThoseThatRoundingMayFlip) {
  const SurfacePoint floor{.position = {0, 0, -10}, .normal = {0, 1, 0}, .view = {0, 1, 0}};
  auto marginal = [&](const OracleLight& light) { return shade(floor, light).marginal; };
  for (double side : {-1.0, 1.0}) {
    OracleLight box{
        .position = {0, 2 * (1 + side * 0.5e-5), -10}, .radius = 9, .box = true, .half_extents = {2, 3, 2}};
    EXPECT_EQ(marginal(box), 1u) << "at a face";
    box.position.y = 2 * (1 + side * 3e-5);
    EXPECT_EQ(marginal(box), 0u);
    box.position = {7, 2, -10};
    EXPECT_EQ(marginal(box), 0u) << "outside another face anyway";
    OracleLight tube{.position = {0, 2, -10}, .radius = 2 * (1 + side * 0.5e-5), .half_length = 5};
    EXPECT_EQ(marginal(tube), 1u) << "at the radius";
    tube.radius = 2 * (1 + side * 3e-5);
    EXPECT_EQ(marginal(tube), 0u);
    // 5 m along the segment, single precision knows the distance to it only by its rounding of 5 m.
    tube.position.x = 5;
    EXPECT_EQ(marginal(tube), 1u);
    tube.radius = 2 * (1 + side * 10e-5);
    EXPECT_EQ(marginal(tube), 0u);
  }
}

TEST(OracleShapes, APointOnTheSegmentIsFiniteAndLitAlongTheNormal) {
  const SurfacePoint floor{.position = {0, 0, -10}, .normal = {0, 1, 0}, .view = {0, 1, 0}};
  for (double along : {0.0, 1.0, -2.0}) {
    OracleLight tube{.position = {along, 0, -10}, .radius = 3, .half_length = 2};
    const OracleAnswer answer = shade(floor, tube);
    EXPECT_EQ(answer.contributing, 1u);
    EXPECT_TRUE(std::isfinite(answer.radiance.x));
    EXPECT_EQ(answer.radiance.x, shade(floor, {.position = {0, 0, -10}, .radius = 3}).radiance.x);
  }
}

}  // namespace
