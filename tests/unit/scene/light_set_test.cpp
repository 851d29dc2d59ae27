#include "harness/scene/light_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <tuple>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/scene/light_law.h"
#include "harness/scene/mesh_builder.h"
#include "harness/scene/procedural.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A box of 40 x 20 x 10 m and, far smaller in area, a needle: triangles are not alike.
const Scene& level() {
  static const Scene scene = [] {
    MeshBuilder mesh;
    uint32_t material = mesh.add_material({});
    mesh.box({-20, 0, -5}, {20, 20, 5}, material);
    mesh.box({-1, 0, -1}, {1, 1, 1}, material);
    Scene built = mesh.finish();
    built.name = "boxes";
    return built;
  }();
  return scene;
}

LightSpec spec_of(uint32_t count, Placement placement = Placement::volume) {
  LightSpec spec;
  spec.count = count;
  spec.placement = placement;
  return spec;
}

bool same_bits(const std::vector<Light>& a, const std::vector<Light>& b) {
  auto key = [](const Light& l) {
    return std::make_tuple(l.position.x, l.position.y, l.position.z, l.radius, l.intensity.x, l.intensity.y,
                           l.intensity.z, l.shape, l.direction.x, l.direction.y, l.direction.z, l.inner_angle,
                           l.outer_angle);
  };
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (key(a[i]) != key(b[i])) return false;
  }
  return true;
}

TEST(LightLaw, MomentsAreThoseOfTheParetoLaw) {
  RadiusMoments moments = radius_moments(32);
  EXPECT_NEAR(moments.mean, 1.94, 0.005);
  EXPECT_NEAR(moments.square, 6.94, 0.005);
  EXPECT_NEAR(moments.cube, 62.1, 0.1);
  for (float ratio : {1.0f, 2.0f, 32.0f, 1000.0f}) {
    // The midpoint rule in u over the law itself.
    double mean = 0, square = 0, cube = 0;
    constexpr int kSteps = 1 << 22;
    for (int i = 0; i < kSteps; ++i) {
      double r = pareto_radius(static_cast<float>((i + 0.5) / kSteps), 1, ratio);
      mean += r / kSteps;
      square += r * r / kSteps;
      cube += r * r * r / kSteps;
    }
    RadiusMoments formula = radius_moments(static_cast<double>(ratio));
    EXPECT_NEAR(mean / formula.mean, 1, 2e-3) << ratio;
    EXPECT_NEAR(square / formula.square, 1, 1e-2) << ratio;
    EXPECT_NEAR(cube / formula.cube, 1, ratio > 100 ? 0.2 : 2e-2) << ratio;
  }
}

TEST(LightLaw, RadiiStayBetweenTheirEnds) {
  for (float s : {0.01f, 0.6f, 7.0f}) {
    EXPECT_EQ(pareto_radius(0, s, 32), s);
    float last = 0;
    for (uint32_t i = 0; i < 4096; ++i) {
      float r = pareto_radius(static_cast<float>(i) / 4096, s, 32);
      EXPECT_GE(r, last);
      last = r;
    }
    EXPECT_LE(pareto_radius(unit_float(0xffffffffu), s, 32), s * 32.001f);
    EXPECT_EQ(pareto_radius(0.7f, s, 1), s);
  }
}

TEST(LightLaw, OverdrawStaysOrGrowsWithTheCount) {
  for (Placement placement : {Placement::volume, Placement::area, Placement::triangle}) {
    double power = placement == Placement::volume ? 3 : 2;
    double first = -1;
    for (uint32_t count : {1u, 100u, 65536u, 1048576u}) {
      double s = size_for_count(0.7, count, Sizing::const_overdraw, placement);
      double overdraw = count * std::pow(s, power);
      if (first < 0) first = overdraw;
      EXPECT_NEAR(overdraw / first, 1, 1e-12);
      EXPECT_EQ(size_for_count(0.7, count, Sizing::fixed_size, placement), 0.7);
    }
    EXPECT_EQ(size_for_count(0.7, 65536, Sizing::const_overdraw, placement), 0.7);
  }
}

TEST(LightLaw, TheCanyonHasItsOwnSizeAndOtherLevelsAboutThreeLightsPerPoint) {
  Scene canyon;
  canyon.name = "canyon";
  EXPECT_EQ(default_base_size(canyon, Placement::volume, 32), 0.6);
  double s = default_base_size(level(), Placement::volume, 32);
  EXPECT_NEAR(0.7 * 65536 * (4 * 3.14159265 / 3) * radius_moments(32).cube * s * s * s / (40 * 20 * 10), 3,
              1e-3);
  EXPECT_GT(default_base_size(make_plane(), Placement::volume, 32), 0);
  EXPECT_EQ(default_base_size(Scene(), Placement::volume, 32), 1);
}

TEST(SineOfTurns, IsTheSine) {
  for (int i = -4000; i <= 4000; ++i) {
    double turns = i / 777.0;
    EXPECT_NEAR(sine_of_turns(turns), std::sin(turns * 6.283185307179586), 1e-11);
    EXPECT_NEAR(cosine_of_turns(turns), std::cos(turns * 6.283185307179586), 1e-11);
  }
}

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

TEST(LightSet, ALightKeepsItsPlaceColourAndShareOfTheLawWhateverTheCount) {
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

TEST(LightSet, RadiusAndHeightOverrideTheLaw) {
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
    EXPECT_NEAR(mean * 0.75 * 0.75 / (half * half), 2, 1e-4);
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
  EXPECT_EQ(set.base().size(), 5u);
  uint32_t refused = 0;
  for (const auto& [reason, count] : set.rejected()) refused += count;
  EXPECT_EQ(refused + set.base().size(), scene.lights.size());
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

TEST(LightScripts, AreFunctionsOfTheFrameAlone) {
  for (LightScript script : {LightScript::none, LightScript::drift, LightScript::spawn}) {
    LightSpec spec = spec_of(3000);
    spec.script = script;
    LightSet set(spec, level());
    std::vector<Light> there, back;
    set.at(7, 120, 40, there);
    for (uint32_t frame : {0u, 119u, 7u}) set.at(frame, 120, 40, back);
    EXPECT_TRUE(same_bits(there, back));
    set.at(8, 120, 40, back);
    EXPECT_EQ(same_bits(there, back), script == LightScript::none);
    // A camera that stands still does not stop the lights.
    set.at(1, 10, 0, there);
    set.at(2, 10, 0, back);
    EXPECT_EQ(same_bits(there, back), script == LightScript::none);
  }
}

TEST(LightScripts, DriftStaysWithinTheRadiusAndComesRound) {
  LightSpec spec = spec_of(2000);
  spec.script = LightScript::drift;
  LightSet set(spec, level());
  std::vector<Light> out;
  double moved = 0;
  for (uint32_t frame = 0; frame < 100; ++frame) {
    set.at(frame, 100, 40, out);
    ASSERT_EQ(out.size(), set.base().size());
    for (size_t i = 0; i < out.size(); ++i) {
      double distance = glm::length(out[i].position - set.base()[i].position);
      EXPECT_LE(distance, out[i].radius);
      EXPECT_EQ(out[i].position.y, set.base()[i].position.y);
      moved += distance / out[i].radius;
    }
  }
  EXPECT_GT(moved / (100 * 2000), 0.2);
}

TEST(LightScripts, SpawnShowsAboutSeventyPercentAndFadesByTheRadius) {
  LightSpec spec = spec_of(4000);
  spec.script = LightScript::spawn;
  LightSet set(spec, level());
  std::vector<Light> out;
  double shown = 0;
  std::set<double> seen;
  for (uint32_t frame = 0; frame < 60; ++frame) {
    set.at(frame, 60, 30, out);
    shown += static_cast<double>(out.size());
    size_t base = 0;
    for (const Light& light : out) {
      ASSERT_EQ(rejection_reason(light), nullptr);
      // Ascending identity: every light is found further on in the base.
      while (base < set.base().size() && set.base()[base].position != light.position) ++base;
      ASSERT_LT(base, set.base().size());
      double fade = light.radius / set.base()[base].radius;
      EXPECT_LE(fade, 1);
      EXPECT_NEAR(light.intensity.x / set.base()[base].intensity.x, fade * fade, 1e-5);
      seen.insert(light.position.x);
    }
  }
  EXPECT_NEAR(shown / (60 * 4000), 0.7, 0.02);
  EXPECT_GT(seen.size(), 3990u);
}

TEST(LightScripts, ASteadyFrameAllocatesNothing) {
  for (LightScript script : {LightScript::none, LightScript::drift, LightScript::spawn}) {
    LightSpec spec = spec_of(5000);
    spec.script = script;
    LightSet set(spec, level());
    std::vector<Light> out;
    set.at(0, 50, 10, out);
    const Light* place = out.data();
    size_t capacity = out.capacity();
    for (uint32_t frame = 1; frame < 50; ++frame) {
      set.at(frame, 50, 10, out);
      EXPECT_EQ(out.data(), place);
      EXPECT_EQ(out.capacity(), capacity);
    }
  }
}

TEST(LightNames, AreAsManyAsTheEnumerators) {
  EXPECT_EQ(placement_names(), (std::vector<std::string>{"volume", "triangle", "area", "gltf"}));
  EXPECT_EQ(sizing_names(), (std::vector<std::string>{"const_overdraw", "fixed_size"}));
  EXPECT_EQ(light_script_names(), (std::vector<std::string>{"static", "drift", "spawn"}));
}

}  // namespace
}  // namespace ml
