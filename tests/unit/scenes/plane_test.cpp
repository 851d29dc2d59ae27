#include <gtest/gtest.h>

#include "harness/lights/set.h"
#include "level_checks.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

constexpr double kPi = 3.141592653589793;

TEST(Plane, IsTwoTrianglesThatFaceUp) {
  Scene scene = make_scene("plane");
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.vertices.size(), 4u);
  for (const Vertex& v : scene.vertices) EXPECT_EQ(v.normal, glm::vec3(0, 1, 0));
  RayCaster rays(scene);
  auto hit = rays.nearest({3, 5, 7}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_TRUE(hit->front);
}

TEST(Plane, LightsAreEqualAndAtOneHeightWhateverThePlacement) {
  Scene scene = make_scene("plane");
  for (Placement placement : {Placement::volume, Placement::triangle, Placement::area}) {
    LightSpec spec;
    spec.placement = placement;
    spec.count = 1000;
    LightSet set(spec, scene);
    for (const Light& light : set.base()) {
      EXPECT_EQ(light.radius, scene.light_defaults.radius);
      EXPECT_EQ(light.position.y, scene.light_defaults.height);
      EXPECT_LE(std::abs(light.position.x), 50);
      EXPECT_LE(std::abs(light.position.z), 50);
    }
    spec.radius = 7;
    spec.height = 3;
    LightSet other(spec, scene);
    for (const Light& light : other.base()) {
      EXPECT_EQ(light.radius, 7);
      EXPECT_EQ(light.position.y, 3);
    }
  }
}

// N pi (r^2 - h^2) / 10^4 lights reach a point away from the edges; the mean over seeds and points comes near
// to it.
TEST(Plane, LightsPerPixelHaveTheClosedForm) {
  Scene scene = make_scene("plane");
  for (auto [count, radius, height] :
       {std::tuple{1000u, 4.0f, 2.0f}, {5000u, 2.0f, 0.5f}, {300u, 9.0f, 8.0f}}) {
    double sum = 0, points = 0;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
      LightSpec spec;
      spec.placement = Placement::area;
      spec.count = count;
      spec.radius = radius;
      spec.height = height;
      spec.seed = seed;
      LightSet set(spec, scene);
      for (double x = -40; x <= 40; x += 4) {
        for (double z = -40; z <= 40; z += 4) {
          ++points;
          for (const Light& light : set.base()) {
            glm::dvec3 step = light.position - glm::dvec3(x, 0, z);
            if (glm::dot(step, step) < radius * radius) ++sum;
          }
        }
      }
    }
    double expected = count * kPi * static_cast<double>(radius * radius - height * height) / 1e4;
    EXPECT_NEAR(sum / points / expected, 1, 0.03) << count << " " << radius << " " << height;
  }
}

TEST(Plane, ThePathAboveSeesNothingNearAnEdge) {
  Scene scene = make_scene("plane");
  RayCaster rays(scene);
  DepthProbe seen = probe(rays, scene.path("above").sample(0, 1, 160, 90, scene.near, scene.far), 160, 90);
  EXPECT_EQ(seen.points.size(), 160u * 90);
  for (const glm::dvec3& point : seen.points) {
    expect_in(describe_scene("plane").wanted.number("seen_from_above"), std::abs(point.x), "x");
    expect_in(describe_scene("plane").wanted.number("seen_from_above"), std::abs(point.z), "z");
  }
}

TEST(Plane, TheDefaultPathStaysAboveTheGround) {
  Scene scene = make_scene("plane");
  RayCaster rays(scene);
  for (uint32_t frame = 0; frame < 120; ++frame) {
    DepthProbe seen = probe(rays, scene.paths[0].sample(frame, 120, 160, 90, scene.near, scene.far));
    EXPECT_EQ(seen.back_sides, 0u);
    EXPECT_GT(seen.nearest, 5);
    EXPECT_GT(seen.points.size(), 1200u);
  }
}

}  // namespace
}  // namespace ml
