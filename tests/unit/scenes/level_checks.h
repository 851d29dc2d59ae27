// What holds for every procedural scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "harness/base/random.h"
#include "harness/lights/set.h"
#include "harness/scene/ray_caster.h"
#include "harness/scene/scene.h"
#include "scenes/wanted.h"
#include "tests/support/depth_probe.h"

namespace ml {

inline void expect_in(const Range& range, double value, const std::string& what) {
  EXPECT_TRUE(range.holds(value)) << what << " is " << value << ", wanted is [" << range.low << ", "
                                  << range.high << "]";
}

// Of all vertices and triangles, and of the default path.
inline uint32_t hash_of(const Scene& scene) {
  uint32_t hash = 0;
  for (const Vertex& v : scene.vertices) {
    std::array<uint32_t, 8> words;
    std::memcpy(words.data(), &v, sizeof v);
    for (uint32_t word : words) hash = hash_u32(hash, word);
  }
  for (uint32_t index : scene.indices) hash = hash_u32(hash, index);
  for (const CameraKey& key : scene.paths[0].keys) {
    hash = hash_u32(hash, static_cast<uint32_t>(std::bit_cast<uint64_t>(key.position.y) >> 12));
  }
  return hash;
}

// Welded on the grid of 1/1024 m, every vertex used, every triangle with an area and with shading normals on
// its counter-clockwise side.
inline void expect_sound(const Scene& scene) {
  std::set<std::array<uint32_t, 8>> vertices;
  for (const Vertex& v : scene.vertices) {
    std::array<uint32_t, 8> words;
    std::memcpy(words.data(), &v, sizeof v);
    EXPECT_TRUE(vertices.insert(words).second) << "twice the same vertex";
    EXPECT_NEAR(glm::length(v.normal), 1, 1e-6);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(std::isfinite(v.position[axis]));
      EXPECT_EQ(v.position[axis] * 1024, std::round(v.position[axis] * 1024));
    }
  }
  std::vector<bool> used(scene.vertices.size(), false);
  for (uint32_t index : scene.indices) {
    ASSERT_LT(index, scene.vertices.size());
    used[index] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  uint32_t next = 0;
  for (const Draw& draw : scene.draws) {
    EXPECT_EQ(draw.first_index, next);
    EXPECT_EQ(draw.index_count % 3, 0u);
    EXPECT_LT(draw.material, scene.materials.size());
    next += draw.index_count;
  }
  EXPECT_EQ(next, scene.indices.size());
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    const Vertex& a = scene.vertices[scene.indices[i]];
    const Vertex& b = scene.vertices[scene.indices[i + 1]];
    const Vertex& c = scene.vertices[scene.indices[i + 2]];
    glm::dvec3 normal = glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position));
    ASSERT_GT(glm::dot(normal, normal), 0);
    ASSERT_GT(glm::dot(normal, glm::dvec3(a.normal + b.normal + c.normal)), 0) << i;
  }
}

// By triangle: is its material drawn from both sides?
inline std::vector<bool> double_sided(const Scene& scene) {
  std::vector<bool> result(scene.triangle_count(), false);
  for (const Draw& draw : scene.draws) {
    if (!scene.materials[draw.material].double_sided) continue;
    auto first = result.begin() + draw.first_index / 3;
    std::fill(first, first + draw.index_count / 3, true);
  }
  return result;
}

// Along a path: no view of a wall's inner side, nothing within half a metre, a way that is free from each
// frame to the next, and something below.
inline void expect_free_camera(const Scene& scene, const RayCaster& rays, const CameraPath& path,
                               uint32_t frames, const Range& median) {
  std::vector<bool> both_sides = double_sided(scene);
  glm::dvec3 last(0);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    Camera camera = path.sample(frame, frames, 64, 36, scene.near, scene.far);
    DepthProbe seen = probe(rays, camera, 32, 18);
    for (uint32_t triangle : seen.seen_from_behind) {
      EXPECT_TRUE(both_sides[triangle]) << "triangle " << triangle << " from behind, frame " << frame;
    }
    EXPECT_GT(seen.nearest, 0.5) << "frame " << frame;
    expect_in(median, seen.quantile(0.5), "median depth of frame " + std::to_string(frame));
    glm::dvec3 here(camera.position);
    auto below = rays.nearest(here, {0, -1, 0});
    ASSERT_TRUE(below) << "below the ground, frame " << frame;
    EXPECT_TRUE(below->front || both_sides[below->triangle]) << "inside something, frame " << frame;
    if (frame > 0) {
      EXPECT_TRUE(rays.clear(last, here)) << "frame " << frame;
    }
    last = here;
  }
}

// How many lights' balls hold a visible point, over every fourth frame of a path of 120.
struct LightsSeen {
  double mean = 0;
  uint32_t max = 0;
};
inline LightsSeen lights_seen(const Scene& scene, const RayCaster& rays, const CameraPath& path,
                              const LightSet& set) {
  constexpr uint32_t kCiFrames = 120;
  LightsSeen seen;
  double lights = 0, points = 0;
  for (uint32_t frame = 0; frame < kCiFrames; frame += 4) {
    Camera camera = path.sample(frame, kCiFrames, 64, 36, scene.near, scene.far);
    for (const glm::dvec3& point : probe(rays, camera, 30, 17).points) {
      uint32_t here = 0;
      for (const Light& light : set.base()) {
        glm::dvec3 step = light.position - point;
        double radius = light.radius;
        if (glm::dot(step, step) < radius * radius) ++here;
      }
      ++points;
      lights += here;
      seen.max = std::max(seen.max, here);
    }
  }
  seen.mean = lights / points;
  return seen;
}

}  // namespace ml
