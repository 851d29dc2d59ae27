// Capsules, wedges and boxes: how many, how large, and which are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

LightSpec mixed(uint32_t count) {
  LightSpec spec = spec_of(count);
  spec.spot_fraction = 0.1f, spec.capsule_fraction = 0.2f, spec.wedge_fraction = 0.3f,
  spec.box_fraction = 0.25f;
  return spec;
}

// Whether the light's volume holds a point, by the definitions of light.h.
bool holds(const Light& light, const glm::dvec3& point) {
  glm::dvec3 from = point - light.position, side(light.side), direction(light.direction);
  if (light.shape == LightShape::box)
    return std::abs(glm::dot(from, side)) < double{light.half_extents.x} &&
           std::abs(glm::dot(from, glm::cross(direction, side))) < double{light.half_extents.y} &&
           std::abs(glm::dot(from, direction)) < double{light.half_extents.z};
  if (has_segment(light.shape)) {
    double half = light.half_length;
    from -= side * std::clamp(glm::dot(from, side), -half, half);
  }
  double distance = glm::length(from);
  if (!(distance < double{light.radius})) return false;
  return !has_cone(light.shape) || glm::dot(from, direction) > distance * std::cos(double{light.outer_angle});
}

double volume(const Light& light, Random& random) {
  const double reach = double{light.radius} + double{light.half_length};
  uint32_t inside = 0;
  constexpr uint32_t samples = 60000;
  for (uint32_t i = 0; i < samples; ++i) {
    glm::dvec3 u(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    inside += holds(light, light.position + reach * u);
  }
  return 8 * reach * reach * reach * inside / samples;
}

TEST(LightShapes, AreTheWantedSharesAndWellFormed) {
  LightSet set(mixed(20000), level());
  EXPECT_TRUE(set.rejected().empty());
  std::vector<double> counts(5, 0.0);
  for (const Light& light : set.base()) {
    ASSERT_EQ(rejection_reason(light), nullptr);
    ++counts[static_cast<size_t>(light.shape)];
    if (has_segment(light.shape)) {
      EXPECT_GE(light.half_length, 0.499f * light.radius);
      EXPECT_LE(light.half_length, 2.001f * light.radius);
    }
    if (light.shape == LightShape::wedge || light.shape == LightShape::box) {
      EXPECT_NEAR(glm::dot(light.side, light.direction), 0, 1e-6);
    }
  }
  const double expected[] = {0.15, 0.1, 0.2, 0.3, 0.25};
  for (size_t shape = 0; shape < 5; ++shape) EXPECT_NEAR(counts[shape] / 20000, expected[shape], 0.015);
}

TEST(LightShapes, ProbeLightsAreTheirShareOfEveryShapeAndOtherwiseWhatTheyWere) {
  LightSpec spec = mixed(20000);
  LightSet direct(spec, level());
  spec.probe_fraction = 0.3f;
  LightSet some(spec, level());
  ASSERT_EQ(some.base().size(), direct.base().size());
  std::vector<double> all(5, 0.0), probes(5, 0.0);
  for (size_t i = 0; i < some.base().size(); ++i) {
    const Light &a = direct.base()[i], &b = some.base()[i];
    EXPECT_FALSE(a.probe);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_TRUE(b.probe || a.intensity == b.intensity) << i;
    ++all[static_cast<size_t>(b.shape)];
    probes[static_cast<size_t>(b.shape)] += b.probe;
  }
  for (size_t shape = 0; shape < 5; ++shape) EXPECT_NEAR(probes[shape] / all[shape], 0.3, 0.05) << shape;
}

TEST(LightShapes, OmniLightsAndSpotsStayWhatTheyAreBesideOthers) {
  LightSpec with = mixed(2000), without = with;
  without.capsule_fraction = without.wedge_fraction = without.box_fraction = 0;
  LightSet a(with, level()), b(without, level());
  for (size_t i = 0; i < 2000; ++i) {
    EXPECT_EQ(a.base()[i].position, b.base()[i].position);
    if (a.base()[i].shape > LightShape::spot) continue;
    EXPECT_EQ(a.base()[i].radius, b.base()[i].radius);
    EXPECT_EQ(a.base()[i].intensity, b.base()[i].intensity);
    EXPECT_EQ(a.base()[i].shape, b.base()[i].shape);
  }
}

TEST(LightShapes, FillTheVolumeOfTheLightThatTheyReplace) {
  Random random(4);
  LightSpec omni = spec_of(60), shaped = omni;
  omni.radius = shaped.radius = 3;
  LightSpec spots = omni;
  spots.spot_fraction = 1;
  const LightSet cones(spots, level());
  for (LightShape shape : {LightShape::capsule, LightShape::wedge, LightShape::box}) {
    shaped = omni;
    (shape == LightShape::capsule ? shaped.capsule_fraction
     : shape == LightShape::wedge ? shaped.wedge_fraction
                                  : shaped.box_fraction) = 1;
    const LightSet set(shaped, level());
    double sum = 0, expected = 0;
    for (size_t i = 0; i < set.base().size(); ++i) {
      EXPECT_EQ(set.base()[i].shape, shape);
      sum += volume(set.base()[i], random);
      double sector =
          shape == LightShape::wedge ? (1 - std::cos(double{cones.base()[i].outer_angle})) / 2 : 1;
      expected += sector * 4 / 3 * 3.14159265 * 27;
    }
    EXPECT_NEAR(sum / expected, 1, 0.02) << light_shape_names()[static_cast<size_t>(shape)];
  }
}

TEST(LightShapes, SharesOfMoreThanAllLightsAreAnError) {
  LightSpec spec = spec_of(10);
  spec.spot_fraction = 0.5f, spec.box_fraction = 0.6f;
  EXPECT_THROW(LightSet(spec, level()), UsageError);
  spec.spot_fraction = 0.1f, spec.capsule_fraction = 0.2f, spec.wedge_fraction = 0.3f,
  spec.box_fraction = 0.4f;
  EXPECT_EQ(LightSet(spec, level()).base().size(), 10u);
}

TEST(LightShapes, SpawnFadesTheWholeSize) {
  LightSpec spec = mixed(4000);
  spec.script = LightScript::spawn;
  LightSet set(spec, level());
  std::vector<Light> out;
  for (uint32_t frame = 0; frame < 20; ++frame) {
    set.at(frame, 20, 30, out);
    size_t base = 0;
    for (const Light& light : out) {
      ASSERT_EQ(rejection_reason(light), nullptr);
      while (set.base()[base].position != light.position) ++base;
      const Light& whole = set.base()[base];
      const float fade = light.radius / whole.radius;
      EXPECT_NEAR(light.half_length, whole.half_length * fade, 1e-5f * whole.half_length);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(light.half_extents[axis], whole.half_extents[axis] * fade,
                    1e-5f * whole.half_extents[axis]);
      EXPECT_NEAR(light.intensity.x, whole.intensity.x * fade * fade, 1e-5f * whole.intensity.x);
    }
  }
}

TEST(LightShapes, ARadiusGivenForAFilesBoxScalesIt) {
  Scene scene = level();
  Light light;
  make_box(light, {1, 2, 2});
  scene.lights.assign(2, light);
  scene.lights[1].half_extents.y = 0;
  LightSpec spec = spec_of(2, Placement::gltf);
  spec.radius = 6;
  LightSet set(spec, scene);
  ASSERT_EQ(set.base().size(), 1u);
  EXPECT_EQ(set.base()[0].radius, 6);
  EXPECT_EQ(set.base()[0].half_extents, glm::vec3(2, 4, 4));
  EXPECT_EQ(set.rejected().at("half extent is 0"), 1u);
}

TEST(LightShapes, UnusableOnesAreRefusedWithTheirReason) {
  Light capsule, wedge, box;
  capsule.shape = LightShape::capsule, capsule.half_length = 2;
  wedge.shape = LightShape::wedge, wedge.half_length = 2;
  make_box(box, {1, 2, 3});
  for (const Light& light : {capsule, wedge, box}) EXPECT_EQ(rejection_reason(light), nullptr);
  auto reason = [](Light light, auto change) {
    change(light);
    const char* found = rejection_reason(light);
    return std::string(found ? found : "accepted");
  };
  for (const Light& light : {capsule, wedge}) {
    EXPECT_EQ(reason(light, [](Light& l) { l.half_length = 0; }), "accepted") << "both ends at one point";
    EXPECT_EQ(reason(light, [](Light& l) { l.half_length = -1; }), "half length is negative");
    EXPECT_EQ(reason(light, [](Light& l) { l.half_length = kNan; }), "half length is not finite");
    EXPECT_EQ(reason(light, [](Light& l) { l.half_length = kInfinity; }), "half length is not finite");
    EXPECT_EQ(reason(light, [](Light& l) { l.half_length = 1e30f; }), "half length is above 1e12 m");
    EXPECT_EQ(reason(light, [](Light& l) { l.radius = 0; }), "radius is 0");
  }
  for (const Light& light : {capsule, wedge, box}) {
    EXPECT_EQ(reason(light, [](Light& l) { l.side = glm::vec3(0); }), "side is not of unit length");
    EXPECT_EQ(reason(light, [](Light& l) { l.side.y = kNan; }), "side is not finite");
    EXPECT_EQ(reason(light, [](Light& l) { l.side = -l.side; }), "accepted") << "reflected";
  }
  for (const Light& light : {wedge, box}) {
    EXPECT_EQ(reason(light, [](Light& l) { l.side = l.direction; }), "side is not across the direction");
    EXPECT_EQ(reason(light, [](Light& l) { l.direction *= 2; }), "direction is not of unit length");
  }
  EXPECT_EQ(reason(capsule, [](Light& l) { l.direction = glm::vec3(kNan); }), "accepted") << "it has none";
  EXPECT_EQ(reason(wedge, [](Light& l) { l.outer_angle = 0; }), "outer cone angle is not above 0");
  for (int axis = 0; axis < 3; ++axis) {
    auto extent = [&](float value) {
      return reason(box, [&](Light& l) {
        glm::vec3 half = l.half_extents;
        half[axis] = value;
        make_box(l, half);
      });
    };
    EXPECT_EQ(extent(0), "half extent is 0");
    EXPECT_EQ(extent(-1), "half extent is negative");
    EXPECT_EQ(extent(kNan), "half extent is not finite");
    EXPECT_EQ(extent(kInfinity), "half extent is not finite");
    EXPECT_EQ(extent(1e-20f), "half extent is below 1e-12 m");
    EXPECT_EQ(extent(2e12f), "radius is above 1e12 m");
  }
  EXPECT_EQ(reason(box, [](Light& l) { l.radius *= 2; }), "radius is not the box's half diagonal");
}

TEST(LightShapes, NamesAreInTheOrderOfTheEnumerators) {
  EXPECT_EQ(light_shape_names(), (std::vector<std::string>{"omni", "spot", "capsule", "wedge", "box"}));
}

}  // namespace
}  // namespace ml
