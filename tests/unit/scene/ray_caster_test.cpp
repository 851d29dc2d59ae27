#include "harness/scene/ray_caster.h"

#include <gtest/gtest.h>

#include "harness/base/random.h"
#include "harness/scene/mesh_builder.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

glm::dvec3 random_point(Random& random, float size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Scene soup(uint32_t triangles, float size, float edge, uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < triangles; ++i) {
    glm::dvec3 corner = random_point(random, size);
    for (int k = 0; k < 3; ++k) {
      scene.indices.push_back(static_cast<uint32_t>(scene.vertices.size()));
      scene.vertices.push_back({glm::vec3(corner + random_point(random, edge)), {0, 1, 0}, {0, 0}});
    }
  }
  return scene;
}

// Distance and triangle by a way of its own: the plane first, then the sides by areas.
std::optional<RayHit> brute_force(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction,
                                  double limit) {
  std::optional<RayHit> best;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    glm::dvec3 p[3];
    for (uint32_t k = 0; k < 3; ++k) p[k] = glm::dvec3(scene.vertices[scene.indices[3 * t + k]].position);
    glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    double slope = glm::dot(normal, direction);
    if (slope == 0) continue;
    double distance = glm::dot(normal, p[0] - origin) / slope;
    if (!(distance > 0 && distance < limit) || (best && distance >= best->distance)) continue;
    glm::dvec3 at = origin + distance * direction;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      inside = inside && glm::dot(normal, glm::cross(p[(k + 1) % 3] - p[k], at - p[k])) >= 0;
    }
    if (inside) best = RayHit{distance, t, slope < 0};
  }
  return best;
}

void expect_like_brute_force(const Scene& scene, uint32_t count, float size, uint64_t seed,
                             uint32_t least_hits) {
  RayCaster rays(scene);
  Random random(seed);
  uint32_t hits = 0;
  for (uint32_t i = 0; i < count; ++i) {
    glm::dvec3 origin = random_point(random, size), direction = random_point(random, 1);
    // A third run along an axis, where slabs have no width.
    if (i % 3 == 0) direction = {i % 9 == 0, i % 9 == 3, i % 9 == 6};
    double limit = i % 2 == 0 ? std::numeric_limits<double>::infinity() : 0.7 * static_cast<double>(size);
    auto expected = brute_force(scene, origin, direction, limit);
    auto found = rays.nearest(origin, direction, limit);
    ASSERT_EQ(found.has_value(), expected.has_value()) << i;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(found->distance, expected->distance, 1e-9 * (1 + expected->distance)) << i;
    EXPECT_EQ(found->triangle, expected->triangle) << i;
    EXPECT_EQ(found->front, expected->front) << i;
    EXPECT_EQ(found->front, glm::dot(rays.normal(found->triangle), direction) < 0) << i;
  }
  EXPECT_GT(hits, least_hits);
}

TEST(RayCaster, FindsWhatBruteForceFinds) {
  expect_like_brute_force(soup(1, 0.5f, 2, 3), 500, 3, 4, 5);
  expect_like_brute_force(soup(7, 2, 2, 5), 500, 4, 6, 8);
  expect_like_brute_force(soup(2000, 10, 1, 7), 3000, 12, 8, 500);
}

TEST(RayCaster, FindsWhatBruteForceFindsInTheCanyon) {
  expect_like_brute_force(make_scene("canyon"), 150, 60, 9, 30);
}

TEST(RayCaster, EmptyScenesAndFlatTrianglesAreNeverHit) {
  EXPECT_FALSE(RayCaster(Scene()).nearest({0, 0, 0}, {1, 0, 0}));
  Scene flat;
  flat.vertices = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0}}, {{1, 1, 0}, {0, 1, 0}, {0, 0}}};
  flat.indices = {0, 1, 2};
  EXPECT_FALSE(RayCaster(flat).nearest({0, 0.5, 0}, {1, 0, 0}));
}

TEST(RayCaster, ManyTrianglesAtOnePositionAreAllKeptAndTheLowestWins) {
  Scene scene;
  for (float x : {0.0f, 1.0f}) scene.vertices.push_back({{x, 0, 0}, {0, 1, 0}, {0, 0}});
  scene.vertices.push_back({{0, 0, 1}, {0, 1, 0}, {0, 0}});
  for (uint32_t i = 0; i < 5000; ++i) scene.indices.insert(scene.indices.end(), {0, 1, 2});
  auto hit = RayCaster(scene).nearest({0.2, 1, 0.2}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0u);
}

TEST(RayCaster, LimitIsExclusiveAndClearSeesBetweenTwoPoints) {
  MeshBuilder mesh;
  uint32_t material = mesh.add_material({});
  mesh.box({1, -1, -1}, {2, 1, 1}, material);
  RayCaster rays(mesh.finish());
  EXPECT_FALSE(rays.nearest({0, 0.1, 0.2}, {1, 0, 0}, 1.0));
  EXPECT_TRUE(rays.nearest({0, 0.1, 0.2}, {1, 0, 0}, 1.0001));
  EXPECT_TRUE(rays.clear({0, 0.1, 0.2}, {0.999, 0.1, 0.2}));
  EXPECT_FALSE(rays.clear({0, 0.1, 0.2}, {3, 0.1, 0.2}));
  EXPECT_EQ(rays.free_length({0, 0.1, 0.2}, {1, 0, 0}, 50), 1.0);
  EXPECT_EQ(rays.free_length({0, 0.1, 0.2}, {-1, 0, 0}, 50), 50.0);
  // From inside a box every ray meets the back of a triangle.
  auto hit = rays.nearest({1.5, 0.1, 0.2}, {0.3, 0.2, 0.1});
  ASSERT_TRUE(hit);
  EXPECT_FALSE(hit->front);
}

}  // namespace
}  // namespace ml
