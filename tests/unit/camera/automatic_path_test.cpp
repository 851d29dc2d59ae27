#include "harness/camera/automatic_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "harness/base/random.h"
#include "harness/camera/view_probe.h"
#include "harness/gltf/gltf.h"
#include "harness/scene/mesh_builder.h"
#include "scenes/scene_registry.h"
#include "tests/support/depth_probe.h"

namespace ml {
namespace {

bool same_path(const CameraPath& a, const CameraPath& b) {
  if (a.keys.size() != b.keys.size()) return false;
  for (size_t i = 0; i < a.keys.size(); ++i) {
    if (a.keys[i].time != b.keys[i].time || a.keys[i].position != b.keys[i].position ||
        a.keys[i].target != b.keys[i].target) {
      return false;
    }
  }
  return true;
}

// What holds for every path, whatever the level.
void expect_sound(const CameraPath& path) {
  EXPECT_EQ(path.name, "default");
  ASSERT_GE(path.keys.size(), 2u);
  EXPECT_LE(path.keys.size(), 32u);
  for (size_t i = 0; i < path.keys.size(); ++i) {
    const CameraKey& key = path.keys[i];
    EXPECT_TRUE(std::isfinite(key.position.x + key.position.y + key.position.z));
    EXPECT_TRUE(std::isfinite(key.target.x + key.target.y + key.target.z));
    EXPECT_NE(key.position, key.target);
    if (i > 0) {
      EXPECT_GT(key.time, path.keys[i - 1].time);
    }
  }
}

void expect_unobstructed(const RayCaster& rays, const CameraPath& path) {
  glm::dvec3 last(0);
  constexpr uint32_t kFrames = 500;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    glm::dvec3 here(path.sample(frame, kFrames, 16, 9, 0.1f, 100).position);
    if (frame > 0 && here != last) {
      EXPECT_TRUE(rays.clear(last, here)) << frame;
    }
    last = here;
  }
}

// A closed room, seen from inside: walls wound to face inwards.
Scene room(const glm::dvec3& size) {
  MeshBuilder mesh;
  uint32_t material = mesh.add_material({});
  mesh.box(-0.5 * size, 0.5 * size, material);
  Scene scene = mesh.finish();
  for (size_t i = 0; i < scene.indices.size(); i += 3) std::swap(scene.indices[i], scene.indices[i + 1]);
  return scene;
}

TEST(AutomaticPath, StaysInAClosedRoomOfEitherWinding) {
  for (bool inward : {true, false}) {
    for (glm::dvec3 size : {glm::dvec3(12, 4, 9), glm::dvec3(3, 2.5, 3), glm::dvec3(300, 40, 200)}) {
      Scene scene = room(size);
      if (!inward) {
        for (size_t i = 0; i < scene.indices.size(); i += 3)
          std::swap(scene.indices[i], scene.indices[i + 1]);
      }
      CameraPath path = automatic_path(scene, 1);
      expect_sound(path);
      // Of a box that shows its outer sides nothing says that it is a room; a path around it will do as well.
      if (!inward) continue;
      for (const CameraKey& key : path.keys) {
        EXPECT_NEAR(key.position.y, -0.5 * size.y + 1.7, 0.01);
        EXPECT_LT(std::abs(key.position.x), 0.5 * size.x);
        EXPECT_LT(std::abs(key.position.z), 0.5 * size.z);
      }
      expect_unobstructed(RayCaster(scene), path);
    }
  }
}

TEST(AutomaticPath, ALowRoomIsWalkedByASmallVisitor) {
  Scene scene = room({2, 0.8, 2});
  CameraPath path = automatic_path(scene, 1);
  expect_sound(path);
  for (const CameraKey& key : path.keys) EXPECT_LT(std::abs(key.position.y), 0.4);
}

TEST(AutomaticPath, DoesNotStandUnderRoofsWithoutHeight) {
  MeshBuilder mesh;
  uint32_t material = mesh.add_material({});
  mesh.quad({-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, material);
  // A slab 1 m above half of the floor: nobody can stand there.
  mesh.box({0, 1, -20}, {20, 1.2, 20}, material);
  Scene scene = mesh.finish();
  RayCaster rays(scene);
  for (const CameraKey& key : automatic_path(scene, 3).keys)
    EXPECT_FALSE(rays.nearest(key.position, {0, 1, 0}));
}

TEST(AutomaticPath, WalksOnAnOpenPlane) {
  Scene scene = make_scene("plane");
  CameraPath path = automatic_path(scene, 1);
  expect_sound(path);
  for (const CameraKey& key : path.keys) EXPECT_NEAR(key.position.y, 1.7, 1e-6);
}

TEST(AutomaticPath, GoesAroundLevelsWithoutFloor) {
  MeshBuilder mesh;
  uint32_t material = mesh.add_material({});
  mesh.quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, material);
  Scene wall = mesh.finish();
  uint32_t tiny_material = mesh.add_material({});
  mesh.box({0, 0, 0}, {0.1, 0.1, 0.1}, tiny_material);
  Scene tiny = mesh.finish();
  for (const Scene& scene : {wall, tiny, Scene()}) {
    CameraPath path = automatic_path(scene, 1);
    expect_sound(path);
    glm::dvec3 center(scene.bounds.center());
    for (const CameraKey& key : path.keys) {
      EXPECT_GT(glm::length(key.position - center),
                0.5 * static_cast<double>(glm::length(scene.bounds.size())));
      EXPECT_EQ(key.target, center);
    }
  }
}

TEST(AutomaticPath, WorksOnTheCanyonAndDependsOnTheSeedAlone) {
  Scene scene = make_scene("canyon");
  RayCaster rays(scene);
  CameraPath path = automatic_path(scene, 1);
  expect_sound(path);
  expect_unobstructed(rays, path);
  EXPECT_TRUE(same_path(path, automatic_path(scene, 1)));
  EXPECT_FALSE(same_path(path, automatic_path(scene, 2)));
  for (const CameraKey& key : path.keys) EXPECT_FALSE(rays.nearest(key.position, {0, 1, 0}, 0.25));
}

// The least share of the picture that is a surface, over frames that fall between the path's own samples.
double least_seen(const Scene& scene, const CameraPath& path, uint32_t frames) {
  const RayCaster rays(scene);
  const ViewProbe probe(scene, rays);
  double least = 1;
  for (uint32_t frame = 0; frame < frames; ++frame)
    least = std::min(least, probe.seen(path.sample(frame, frames, 240, 135, scene.near, scene.far), 64, 36));
  return least;
}

glm::dvec3 random_point(Random& random, double size) {
  return size * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

// Boxes, cards that show one side alone and loose triangles, from millimetres to a kilometre.
Scene random_level(Random& random) {
  MeshBuilder mesh;
  const uint32_t material = mesh.add_material({});
  const double size = std::pow(10.0, static_cast<double>(random.uniform(-3, 3)));
  const auto count = static_cast<int>(random.uniform(1, 8));
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at = random_point(random, size);
    switch (static_cast<int>(random.uniform(0, 3))) {
      case 0: {
        const glm::dvec3 half = glm::abs(random_point(random, size)) + 0.01 * size;
        mesh.box(at - half, at + half, material);
        break;
      }
      case 1: {
        const glm::dvec3 a = random_point(random, size), b = random_point(random, size);
        mesh.quad(at, at + a, at + a + b, at + b, material);
        break;
      }
      default: {
        const double y = size * static_cast<double>(random.uniform(-1, 1));
        mesh.quad({-size, y, -size}, {-size, y, size}, {size, y, size}, {size, y, -size}, material);
      }
    }
  }
  Scene scene = mesh.finish();
  scene.near = std::min(0.1f, 0.01f * glm::length(scene.bounds.size()));
  scene.far = glm::length(scene.bounds.size());
  return scene;
}

TEST(AutomaticPath, EveryFrameOfARandomLevelSeesASurface) {
  Random random(11);
  for (int i = 0; i < 150; ++i) {
    const Scene scene = random_level(random);
    const CameraPath path = automatic_path(scene, static_cast<uint32_t>(i));
    expect_sound(path);
    EXPECT_GT(least_seen(scene, path, 61), 0) << "level " << i;
  }
}

// Seen from outside, as large as the picture allows.
TEST(AutomaticPath, FramesSmallObjects) {
  for (double size : {0.002, 0.1, 2.0, 4.0}) {
    MeshBuilder mesh;
    mesh.box(glm::dvec3(-0.5 * size), glm::dvec3(0.5 * size), mesh.add_material({}));
    Scene scene = mesh.finish();
    scene.near = std::min(0.1f, static_cast<float>(0.01 * size));
    const CameraPath path = automatic_path(scene, 1);
    for (const CameraKey& key : path.keys) EXPECT_GT(glm::length(key.position), 0.87 * size);
    EXPECT_GT(least_seen(scene, path, 31), 0.08) << size;
  }
}

TEST(AutomaticPath, FindsWhatIsSmallInWideBounds) {
  MeshBuilder mesh;
  const uint32_t material = mesh.add_material({});
  mesh.quad({0, 0, 0}, {1e-3, 0, 0}, {1e-3, 1e-3, 0}, {0, 1e-3, 0}, material);
  mesh.quad({500, 90, 0}, {500.01, 90, 0}, {500.01, 90.01, 0}, {500, 90.01, 0}, material);
  const Scene scene = mesh.finish();
  EXPECT_GT(least_seen(scene, automatic_path(scene, 1), 31), 0.01);
}

class RealLevel : public testing::TestWithParam<const char*> {};

TEST_P(RealLevel, IsWalkedInside) {
  const char* shared = std::getenv("MANYLIGHTS_SHARED");
  std::filesystem::path file =
      std::filesystem::path(shared ? shared : ML_SOURCE_DIR "/../shared") / "scenes" / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Scene scene = import_gltf(file, -1, 1, {0, 0, 0});
  RayCaster rays(scene);
  for (uint32_t seed : {1u, 2u, 3u}) {
    CameraPath path = automatic_path(scene, seed);
    expect_sound(path);
    EXPECT_GE(path.keys.size(), 8u);
    expect_unobstructed(rays, path);
    std::vector<double> views;
    double back = 0, all = 0;
    for (const CameraKey& key : path.keys) {
      EXPECT_FALSE(rays.nearest(key.position, {0, 1, 0}, 0.25)) << "no headroom";
      auto floor = rays.nearest(key.position, {0, -1, 0}, 12);
      EXPECT_TRUE(floor) << "no floor below";
      views.push_back(rays.free_length(key.position, glm::normalize(key.target - key.position), 1000));
      DepthProbe seen =
          probe(rays, Camera::look_at(key.position, key.target, Projection::perspective(1, 1.8f, 0.1f, 100)));
      back += seen.back_sides;
      all += static_cast<double>(seen.points.size());
    }
    std::sort(views.begin(), views.end());
    EXPECT_GE(views[views.size() / 2], 8) << "seed " << seed;
    // From inside a solid or below the ground one sees mostly the wrong sides; the levels themselves show
    // some.
    EXPECT_LT(back, 0.4 * all) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, RealLevel,
                         testing::Values("zdm2.glb", "pandora.glb", "oasago2.glb", "islandctf.glb"),
                         [](const auto& level) {
                           return std::filesystem::path(level.param).stem().string();
                         });

}  // namespace
}  // namespace ml
