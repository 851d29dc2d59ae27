#include "harness/lights/set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "harness/base/error.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(LightSet, TakesEveryCountUpToTheLargest) {
  for (uint32_t count : {0u, 1u, 2u, 65535u, 65536u, 65537u, 1048576u}) {
    LightSet set(spec_of(count), level());
    EXPECT_EQ(set.base().size(), count);
    EXPECT_TRUE(set.rejected().empty());
    std::vector<Light> out;
    set.at(0, 1, 0, out);
    EXPECT_EQ(out.size(), count);
  }
  EXPECT_THROW(LightSet(spec_of(1048577), level()), UsageError);
}

TEST(LightSet, ALightKeepsItsPositionColourAndQuantileWhateverTheCount) {
  LightSpec small = spec_of(100), large = spec_of(3000);
  small.spot_fraction = large.spot_fraction = 0.5f;
  LightSet a(small, level()), b(large, level());
  for (size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(a.base()[i].position, b.base()[i].position);
    EXPECT_NEAR(a.base()[i].radius / a.base_size(), b.base()[i].radius / b.base_size(), 1e-4);
    EXPECT_EQ(a.base()[i].direction, b.base()[i].direction);
    EXPECT_EQ(a.base()[i].shape, b.base()[i].shape);
  }
  small.sizing = large.sizing = Sizing::fixed_size;
  std::vector<Light> all = LightSet(large, level()).base();
  all.resize(100);
  EXPECT_TRUE(same_bits(LightSet(small, level()).base(), all));
}

TEST(LightSet, EverythingDependsOnTheSeed) {
  LightSpec spec = spec_of(500);
  LightSet a(spec, level()), again(spec, level());
  EXPECT_TRUE(same_bits(a.base(), again.base()));
  spec.seed = 2;
  LightSet b(spec, level());
  for (size_t i = 0; i < 500; ++i) EXPECT_NE(a.base()[i].position, b.base()[i].position);
}

// Chi-squared of `counts` against equal expectations, divided by its degrees of freedom: about 1 for uniform
// placement.
double unevenness(const std::vector<double>& counts, const std::vector<double>& expected) {
  double sum = 0;
  for (size_t i = 0; i < counts.size(); ++i)
    sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  return sum / static_cast<double>(counts.size() - 1);
}

TEST(LightSet, VolumeIsUniformInTheBox) {
  LightSet set(spec_of(65536), level());
  std::vector<double> counts(512, 0.0), expected(512, 65536.0 / 512);
  for (const Light& light : set.base()) {
    glm::dvec3 u = (light.position - glm::dvec3(-20, 0, -5)) / glm::dvec3(40, 20, 10);
    for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(u[axis] >= 0 && u[axis] <= 1);
    glm::ivec3 cell = glm::min(glm::ivec3(u * 8.0), glm::ivec3(7));
    ++counts[static_cast<size_t>(cell.x * 64 + cell.y * 8 + cell.z)];
  }
  EXPECT_LT(unevenness(counts, expected), 1.3);
  EXPECT_GT(unevenness(counts, expected), 0.7);
}

// Lights lie at half the radius or less along the normal; the triangle is found from the normal and the box
// it belongs to.
void count_by_box(const LightSet& set, double& large, double& small) {
  for (const Light& light : set.base()) {
    bool near_small =
        std::abs(light.position.x) < 1.02 && light.position.y < 1.02 && std::abs(light.position.z) < 1.02;
    ++(near_small ? small : large);
  }
}

TEST(LightSet, TriangleAndAreaPlacementsFollowTheirMeasure) {
  LightSpec spec = spec_of(60000, Placement::triangle);
  spec.radius = 0.01f;
  double large = 0, small = 0;
  count_by_box(LightSet(spec, level()), large, small);
  EXPECT_NEAR(small / 60000, 0.5, 0.02);
  spec.placement = Placement::area;
  large = small = 0;
  count_by_box(LightSet(spec, level()), large, small);
  // The small box has 24 of 2624 m^2; up to 4 m^2 of the large box's floor lie next to it.
  EXPECT_NEAR(small / 60000, 26.0 / 2824, 0.003);
}

TEST(LightSet, SurfaceLightsStandOnTheOuterSideWithinHalfTheirRadius) {
  LightSpec spec = spec_of(5000, Placement::area);
  LightSet set(spec, level());
  double lifted = 0;
  double outside = 0;
  for (const Light& light : set.base()) {
    glm::dvec3 inside =
        glm::min(light.position - glm::dvec3(-20, 0, -5), glm::dvec3(20, 20, 5) - light.position);
    double depth = std::min({inside.x, inside.y, inside.z});
    EXPECT_LE(-depth, 0.5 * light.radius * 1.0001 + 1e-5);
    // The small box stands inside the large one: about 1 % of the lights.
    if (depth > 1e-5) continue;
    ++outside;
    lifted += -depth / light.radius;
  }
  EXPECT_GT(outside, 4900);
  EXPECT_NEAR(lifted / outside, 0.25, 0.02);
}

TEST(LightSet, RadiusAndHeightOverrideTheDistribution) {
  LightSpec spec = spec_of(1000, Placement::area);
  spec.radius = 3;
  spec.height = 1.5f;
  LightSet set(spec, level());
  EXPECT_EQ(set.base_size(), 3);
  double off = 0;
  for (const Light& light : set.base()) {
    EXPECT_EQ(light.radius, 3);
    // Outside the large box, or above the small one inside it, by exactly the height.
    glm::dvec3 inside =
        glm::min(light.position - glm::dvec3(-20, 0, -5), glm::dvec3(20, 20, 5) - light.position);
    double depth = std::min({inside.x, inside.y, inside.z});
    if (std::abs(depth + 1.5) > 1e-5) ++off;
  }
  EXPECT_LT(off, 30);
}

TEST(LightSet, IrradianceAtHalfTheRadiusIsAboutOneForEveryRadius) {
  LightSpec spec = spec_of(20000);
  spec.intensity = 2;
  std::set<float> shades;
  LightSet set(spec, level());
  for (const Light& light : set.base()) {
    double half = 0.5 * light.radius;
    double mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3.0;
    EXPECT_NEAR(mean * 0.9375 * 0.9375 / (half * half), 2, 1e-4);
    shades.insert(light.intensity.x / light.radius / light.radius);
  }
  EXPECT_GT(shades.size(), 5000u);
}

TEST(LightSet, SpotsAreTheWantedShareAndWellFormed) {
  LightSpec spec = spec_of(20000);
  spec.spot_fraction = 0.3f;
  size_t spots = 0;
  LightSet set(spec, level());
  for (const Light& light : set.base()) {
    EXPECT_EQ(rejection_reason(light), nullptr);
    if (light.shape != LightShape::spot) continue;
    ++spots;
    EXPECT_NEAR(glm::length(light.direction), 1, 1e-6);
    EXPECT_LT(light.direction.y, 0);
    EXPECT_LT(light.inner_angle, light.outer_angle);
  }
  EXPECT_NEAR(static_cast<double>(spots) / 20000, 0.3, 0.015);
}

TEST(LightSet, RefusesUnusableLightsAndCountsThemOnce) {
  Scene scene = level();
  Light good;
  auto with = [&](auto change) {
    Light light = good;
    change(light);
    scene.lights.push_back(light);
  };
  with([](Light&) {});
  with([](Light& l) { l.radius = 0; });
  with([](Light& l) { l.radius = -1; });
  with([](Light& l) { l.radius = -kInfinity; });
  with([](Light& l) { l.radius = kNan; });
  with([](Light& l) { l.radius = 1e-40f; });
  with([](Light& l) { l.radius = 3e38f; });
  with([](Light& l) { l.position.y = std::nan(""); });
  with([](Light& l) { l.position.y = 1e300; });
  with([](Light& l) { l.intensity.z = kInfinity; });
  with([](Light& l) { l.intensity.x = -1; });
  with([](Light& l) { l.intensity = glm::vec3(0); });
  with([](Light& l) { l.shape = LightShape::spot; });
  with([](Light& l) { l.shape = LightShape::spot, l.direction = glm::vec3(0); });
  with([](Light& l) { l.shape = LightShape::spot, l.outer_angle = 0; });
  with([](Light& l) { l.shape = LightShape::spot, l.outer_angle = kNan; });
  with([](Light& l) { l.shape = LightShape::spot, l.outer_angle = 4; });
  with([](Light& l) { l.shape = LightShape::spot, l.inner_angle = 1; });
  with([](Light& l) { l.shape = LightShape::spot, l.inner_angle = l.outer_angle; });
  with([](Light& l) { l.direction = glm::vec3(kNan); });  // an omni light has no direction
  LightSet set(spec_of(8192, Placement::gltf), scene);
  EXPECT_EQ(set.base().size(), 4u);
  EXPECT_EQ(set.account().dark, 1u);
  EXPECT_EQ(set.account().rejected() + set.account().used + set.account().dark, scene.lights.size());
  EXPECT_EQ(set.rejected().at("radius is 0"), 1u);
  EXPECT_EQ(set.rejected().at("radius is negative"), 1u);
  EXPECT_EQ(set.rejected().at("radius is not finite"), 2u);
  EXPECT_EQ(set.rejected().at("position is not finite"), 1u);
}

TEST(LightSet, GltfPlacementTakesTheFilesLightsInOrder) {
  Scene scene = level();
  for (int i = 0; i < 10; ++i) {
    Light light;
    light.position.x = i;
    light.radius = 2;
    scene.lights.push_back(light);
  }
  LightSpec spec = spec_of(4, Placement::gltf);
  spec.intensity = 3;
  LightSet set(spec, scene);
  ASSERT_EQ(set.base().size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(set.base()[i].position.x, i);
    EXPECT_EQ(set.base()[i].intensity, glm::vec3(3));
  }
  EXPECT_THROW(LightSet(spec, level()), UsageError);
  EXPECT_THROW(LightSet(spec_of(10, Placement::area), Scene()), UsageError);
  EXPECT_EQ(LightSet(spec_of(0, Placement::area), Scene()).base().size(), 0u);
}

TEST(LightNames, AreAsManyAsTheEnumerators) {
  EXPECT_EQ(placement_names(),
            (std::vector<std::string>{"volume", "triangle", "area", "gltf", "clumps", "stage", "room"}));
  EXPECT_EQ(sizing_names(), (std::vector<std::string>{"const_overdraw", "fixed_size"}));
  EXPECT_EQ(light_script_names(), (std::vector<std::string>{"static", "drift", "spawn", "orbit"}));
}

}  // namespace
}  // namespace ml
