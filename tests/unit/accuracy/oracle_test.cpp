#include "harness/accuracy/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/base/random.h"

namespace {

using namespace ml;
using glm::dvec3;

constexpr double pi = std::numbers::pi;

dvec3 random_direction(Random& random) {
  double z = 2.0 * random.uniform() - 1, angle = 2 * pi * random.uniform(), ring = std::sqrt(1 - z * z);
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

std::vector<OracleLight> random_lights(uint32_t count, uint64_t seed) {
  Random random(seed);
  std::vector<OracleLight> lights(count);
  for (OracleLight& light : lights) {
    light.position = 5.0 * random.uniform() * random_direction(random) + dvec3(0, 0, -10);
    light.radius = 1 + 6 * random.uniform();
    light.intensity = {10 * random.uniform(), 10 * random.uniform(), 10 * random.uniform()};
    if (random.below(3) == 0) {
      light.spot = true;
      light.direction = random_direction(random);
      double outer = std::cos(0.2 + random.uniform()), inner = outer + 0.5 * (1 - outer);
      light.cone_scale = 1 / (inner - outer);
      light.cone_limit = 1 - outer;
    }
  }
  return lights;
}

const SurfacePoint wall{
    .position = {0, 0, -10}, .normal = {0, 0, 1}, .albedo = {0.8, 0.5, 0.2}, .roughness = 0.4};

TEST(OracleFalloff, IsExactlyZeroAtAndBeyondTheRadiusAndPositiveBelow) {
  for (double radius : {1e-3, 0.1, 1.0, 7.3, 100.0, 1e6}) {
    EXPECT_EQ(oracle_falloff(radius, radius), 0);
    EXPECT_EQ(oracle_falloff(std::nextafter(radius, 1e9), radius), 0);
    EXPECT_EQ(oracle_falloff(2 * radius, radius), 0);
    EXPECT_GT(oracle_falloff(std::nextafter(radius, 0), radius), 0);
    EXPECT_TRUE(std::isfinite(oracle_falloff(0, radius)));
  }
  EXPECT_EQ(oracle_falloff(std::nan(""), 1), 0);
}

TEST(OracleFalloff, NeverRisesWithDistance) {
  for (double radius : {0.005, 0.5, 20.0}) {
    double before = oracle_falloff(0, radius);
    for (int i = 1; i <= 5000; ++i) {
      double here = oracle_falloff(radius * i / 5000, radius);
      EXPECT_LE(here, before);
      before = here;
    }
  }
}

TEST(OracleFalloff, IsInverseSquareFarInsideTheWindow) {
  for (double distance : {0.5, 1.0, 4.0})
    EXPECT_NEAR(oracle_falloff(distance, 1e5) * distance * distance, 1, 1e-8);
}

TEST(OracleBrdf, LambertAloneWhenSpecularIsOff) {
  Random random(1);
  SurfacePoint point = wall;
  point.metallic = 0.25;
  for (int i = 0; i < 100; ++i) {
    dvec3 l = random_direction(random), v = random_direction(random);
    if (l.z <= 0) continue;
    dvec3 expected = point.albedo * 0.75 / pi;
    EXPECT_LT(glm::length(oracle_brdf(point, l, v, false) - expected), 1e-15);
  }
}

TEST(OracleBrdf, IsTheSameWithLightAndViewerExchanged) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    SurfacePoint point = wall;
    point.roughness = random.uniform(), point.metallic = random.uniform();
    dvec3 l = random_direction(random), v = random_direction(random);
    if (l.z < 1e-3 || v.z < 1e-3) continue;
    dvec3 there = oracle_brdf(point, l, v, true), back = oracle_brdf(point, v, l, true);
    EXPECT_LT(glm::length(there - back), 1e-9 * glm::length(there));
  }
}

TEST(OracleBrdf, IsFiniteAndNotNegativeEverywhere) {
  Random random(3);
  const dvec3 n{0, 0, 1};
  std::vector<dvec3> directions{
      n, {1, 0, 0}, {-1, 0, 0}, glm::normalize(dvec3(1, 0, 1e-9)), glm::normalize(dvec3(1, 0, -1e-9)), -n};
  for (int i = 0; i < 60; ++i) directions.push_back(random_direction(random));
  for (double roughness : {0.0, 1e-6, 0.045, 0.3, 1.0})
    for (double metallic : {0.0, 1.0})
      for (const dvec3& l : directions)
        for (const dvec3& v : directions) {
          if (glm::dot(n, l) <= 0) continue;
          SurfacePoint point{
              .normal = n, .albedo = {1, 0.5, 0}, .roughness = roughness, .metallic = metallic};
          dvec3 value = oracle_brdf(point, l, v, true);
          for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(value[c]));
            EXPECT_GE(value[c], 0);
          }
        }
}

// Reflected part of a beam from direction `l` for a perfectly reflecting metal, by quadrature over half
// vectors around the normal's lobe: a substitution in the polar angle puts samples where a narrow lobe is.
double specular_albedo(double roughness, double cos_light) {
  SurfacePoint point{.normal = {0, 0, 1}, .albedo = dvec3(1), .roughness = roughness, .metallic = 1};
  dvec3 l{std::sqrt(1 - cos_light * cos_light), 0, cos_light};
  double alpha = std::pow(std::max(roughness, 0.045), 2);
  const int rings = 400, spokes = 400;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    // GGX importance sampling of the half vector: pdf(h) = D N.H, so that the integrand is smooth.
    double u = (i + 0.5) / rings;
    double cos_h = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)),
           sin_h = std::sqrt(std::max(0.0, 1 - cos_h * cos_h));
    double lobe = cos_h * cos_h * (alpha * alpha - 1) + 1, d = alpha * alpha / (pi * lobe * lobe);
    for (int j = 0; j < spokes; ++j) {
      double angle = 2 * pi * (j + 0.5) / spokes;
      dvec3 h{sin_h * std::cos(angle), sin_h * std::sin(angle), cos_h};
      double lh = glm::dot(l, h);
      dvec3 v = 2 * lh * h - l;
      if (v.z <= 0 || lh <= 0) continue;
      double pdf = d * cos_h / (4 * lh);
      sum += oracle_brdf(point, l, v, true).x * v.z / pdf;
    }
  }
  return sum / (rings * spokes);
}

TEST(OracleBrdf, ReflectsNoMoreThanItReceives) {
  for (double roughness : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (double cosine : {0.05, 0.3, 0.7, 0.95, 1.0}) {
      double albedo = specular_albedo(roughness, cosine);
      EXPECT_LE(albedo, 1 + 2e-3) << roughness << " " << cosine;
      EXPECT_GE(albedo, 0.3) << roughness << " " << cosine;
    }
  }
  EXPECT_NEAR(specular_albedo(0.1, 1.0), 1, 0.01) << "a smooth mirror seen from above loses nothing";
}

TEST(Oracle, OneLightByHand) {
  OracleLight light{.position = {0, 0, -8}, .radius = 4, .intensity = {1, 2, 4}};
  OracleAnswer answer = oracle_shade(wall, std::span(&light, 1), false);
  double falloff = 0.9375 * 0.9375 / 4;  // (1 - (2/4)^4)^2 / 2^2
  EXPECT_NEAR(answer.radiance.x, 1 * falloff * 0.8 / pi, 1e-15);
  EXPECT_NEAR(answer.radiance.y, 2 * falloff * 0.5 / pi, 1e-15);
  EXPECT_NEAR(answer.radiance.z, 4 * falloff * 0.2 / pi, 1e-15);
  EXPECT_EQ(answer.contributing, 1u);
  EXPECT_EQ(answer.marginal, 0u);
}

TEST(Oracle, OrderMattersOnlyWithinRounding) {
  std::vector<OracleLight> lights = random_lights(500, 4);
  OracleAnswer forward = oracle_shade(wall, lights, true);
  std::reverse(lights.begin(), lights.end());
  OracleAnswer backward = oracle_shade(wall, lights, true);
  EXPECT_GT(forward.contributing, 20u);
  EXPECT_EQ(forward.contributing, backward.contributing);
  EXPECT_EQ(forward.marginal, backward.marginal);
  EXPECT_LT(glm::length(forward.radiance - backward.radiance), 1e-12 * glm::length(forward.radiance));
}

TEST(Oracle, IsTheSumOfItsLightsAndCountsThoseThatAdd) {
  std::vector<OracleLight> lights = random_lights(300, 5);
  dvec3 sum{0};
  uint32_t counted = 0, visible = 0;
  for (const OracleLight& light : lights) {
    OracleAnswer one = oracle_shade(wall, std::span(&light, 1), true);
    sum += one.radiance;
    counted += one.contributing;
    visible += one.radiance.x > 0;
    EXPECT_LE(one.contributing, 1u);
  }
  OracleAnswer all = oracle_shade(wall, lights, true);
  EXPECT_EQ(all.contributing, counted);
  EXPECT_EQ(counted, visible) << "a light counts exactly when it brings light";
  EXPECT_LT(glm::length(all.radiance - sum), 1e-12 * glm::length(sum));
}

TEST(Oracle, LightsBehindOutOfReachOrBesideTheConeDoNotContribute) {
  auto contributes = [](const OracleLight& light) {
    return oracle_shade(wall, std::span(&light, 1), true).contributing;
  };
  EXPECT_EQ(contributes({.position = {0, 0, -9}, .radius = 2}), 1u);
  EXPECT_EQ(contributes({.position = {0, 0, -11}, .radius = 2}), 0u);
  EXPECT_EQ(contributes({.position = {0, 0, -7.9}, .radius = 2}), 0u);
  OracleLight spot{.position = {0, 0, -9},
                   .radius = 2,
                   .spot = true,
                   .direction = {0, 0, -1},
                   .cone_scale = 10,
                   .cone_limit = 0.1};
  EXPECT_EQ(contributes(spot), 1u);
  spot.direction = {1, 0, 0};
  EXPECT_EQ(contributes(spot), 0u);
}

TEST(Oracle, MarginalLightsAreThoseThatRoundingMayFlip) {
  auto marginal = [](const OracleLight& light) {
    return oracle_shade(wall, std::span(&light, 1), true).marginal;
  };
  for (double side : {-1.0, 1.0}) {
    EXPECT_EQ(marginal({.position = {0, 0, -8}, .radius = 2 * (1 + side * 0.5e-5)}), 1u) << "at the radius";
    EXPECT_EQ(marginal({.position = {0, 0, -8}, .radius = 2 * (1 + side * 3e-5)}), 0u);
    EXPECT_EQ(marginal({.position = {1, 0, -10 + side * 0.5e-5}, .radius = 2}), 1u)
        << "in the surface's plane";
    EXPECT_EQ(marginal({.position = {1, 0, -10 + side * 3e-5}, .radius = 2}), 0u);
    EXPECT_EQ(marginal({.position = {3, 0, -10 + side * 0.5e-5}, .radius = 2}), 0u) << "out of reach anyway";
    OracleLight spot{
        .position = {0, 0, -9}, .radius = 2, .spot = true, .direction = {0, 0, -1}, .cone_scale = 10};
    spot.cone_limit = side * 0.5e-5;
    EXPECT_EQ(marginal(spot), 1u) << "at the cone's edge";
    spot.cone_limit = side * 3e-5;
    EXPECT_EQ(marginal(spot), 0u);
  }
}

TEST(Oracle, LightOnThePointIsFiniteAndShinesAlongTheNormal) {
  for (double away : {0.0, 1e-9, -1e-9, 0.9e-6}) {
    OracleLight light{.position = wall.position + dvec3(0, 0, away), .radius = 3};
    OracleAnswer answer = oracle_shade(wall, std::span(&light, 1), true);
    EXPECT_EQ(answer.contributing, 1u);
    OracleLight above{.position = wall.position + dvec3(0, 0, 2e-6), .radius = 3};
    dvec3 expected = oracle_shade(wall, std::span(&above, 1), true).radiance;
    EXPECT_LT(glm::length(answer.radiance - expected), 1e-6 * glm::length(expected));
  }
}

TEST(Oracle, ViewerIsAtTheOriginUnlessSaid) {
  OracleLight light{.position = {1, 1, -8}, .radius = 9};
  SurfacePoint point{.position = {2, 1, -10}, .normal = {0, 0, 1}, .roughness = 0.2};
  dvec3 perspective = oracle_shade(point, std::span(&light, 1), true).radiance;
  point.view = -glm::normalize(point.position);
  EXPECT_EQ(oracle_shade(point, std::span(&light, 1), true).radiance, perspective);
  point.view = {0, 0, 1};
  EXPECT_NE(oracle_shade(point, std::span(&light, 1), true).radiance, perspective);
  point.view = dvec3(0), point.position = dvec3(0);
  light.position = {0, 0, 1};
  EXPECT_TRUE(std::isfinite(oracle_shade(point, std::span(&light, 1), true).radiance.x))
      << "a point in the camera";
}

TEST(Oracle, ExtremeIntensitiesAddUp) {
  std::vector<OracleLight> lights{{.position = {0, 0, -8}, .radius = 4, .intensity = dvec3(1e9)}};
  OracleLight faint{.position = {0, 0, -8}, .radius = 4, .intensity = dvec3(1e-6)};
  lights.insert(lights.end(), 65536, faint);
  double big = oracle_shade(wall, std::span(lights).first(1), true).radiance.x;
  double all = oracle_shade(wall, lights, true).radiance.x;
  EXPECT_NEAR((all - big) / big, 65536e-15, 65536 * 0x1p-53)
      << "each addition rounds to half an ulp of the sum";
  EXPECT_GT(all, big);
}

}  // namespace
