#include <gtest/gtest.h>

#include <set>

#include "level_checks.h"
#include "scenes/grove/parts.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

const Scene& grove() {
  static const Scene scene = make_scene("grove");
  return scene;
}

TEST(Grove, HasTheSlatsOfItsDescription) {
  for (const Draw& draw : grove().draws) {
    if (grove().materials[draw.material].name == "picket") {
      const double triangles_of_a_slat = 10;
      expect_in(describe_scene("grove").wanted.number("slats"), draw.index_count / 3 / triangles_of_a_slat,
                "slats");
      return;
    }
  }
  FAIL() << "no slats";
}

// Points along the way are as far apart as their lengths say, and directions are those of the way.
TEST(GroveWay, IsMeasuredByLength) {
  GroveWay way;
  constexpr double kStep = 0.25;
  for (double length = 0; length + kStep < way.length(); length += kStep) {
    GroveWay::WayPoint here = way.at(length), next = way.at(length + kStep);
    glm::dvec2 step = next.point - here.point;
    EXPECT_NEAR(std::sqrt(glm::dot(step, step)), kStep, 1e-3) << length;
    EXPECT_NEAR(glm::dot(step, here.ahead), kStep, 2e-3) << length;
    EXPECT_LT(way.distance(here.point), 0.4) << length;
    EXPECT_NEAR(way.distance(here.beside(2)), 2, 0.2) << length;
  }
}

// Only leaves have two sides.
TEST(Grove, LeavesAreOpaqueAndSeenFromBothSides) {
  std::set<std::string> leaves;
  for (const Material& material : grove().materials) {
    EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
    if (material.double_sided) leaves.insert(material.name);
  }
  EXPECT_EQ(leaves, (std::set<std::string>{"leaves", "red leaves", "yellow leaves"}));
}

// The share of tiles of a picture of 1920 x 1080 pixels whose largest depth is more than twice the smallest,
// by the depth of every pixel of tiles drawn at random along the path; the sky has no depth, and tiles with
// nothing else count as flat. Two standard errors of the share are below 0.02 for 2400 tiles.
double deep_tiles(const Scene& scene, const RayCaster& rays, uint32_t tile, uint32_t tiles_a_frame) {
  constexpr uint32_t kWidth = 1920, kHeight = 1080, kFrames = 24;
  Random random(tile);
  uint32_t deep = 0, across = kWidth / tile, down = (kHeight + tile - 1) / tile;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    Camera camera = scene.paths[0].sample(frame, kFrames, kWidth, kHeight, scene.near, scene.far);
    for (uint32_t i = 0; i < tiles_a_frame; ++i) {
      uint32_t x = random.below(across) * tile, y = random.below(down) * tile;
      double nearest = 1e30, farthest = 0;
      // Every pixel once, far apart in turn, so that deep tiles are found early.
      for (uint32_t j = 0; j < tile * tile && !(farthest > 2 * nearest); ++j) {
        uint32_t pixel = j * 37 % (tile * tile);
        uint32_t px = x + pixel % tile, py = y + pixel / tile;
        if (py >= kHeight) continue;
        if (auto hit =
                rays.nearest(glm::dvec3(camera.position), pixel_ray(camera, px, py, kWidth, kHeight))) {
          nearest = std::min(nearest, hit->distance);
          farthest = std::max(farthest, hit->distance);
        }
      }
      deep += farthest > 2 * nearest ? 1 : 0;
    }
  }
  return static_cast<double>(deep) / (kFrames * tiles_a_frame);
}

// Wanted by scenes.md: what makes the grove the worst case for depth bounds.
TEST(Grove, ManyTilesHoldNearAndFarThings) {
  const Wanted& wanted = describe_scene("grove").wanted;
  for (uint32_t seed : {1u, 2u}) {
    Scene scene = make_scene("grove", seed);
    RayCaster rays(scene);
    expect_in(wanted.number("deep_tiles_of_16"), deep_tiles(scene, rays, 16, 100), "deep tiles of 16");
    expect_in(wanted.number("deep_tiles_of_48"), deep_tiles(scene, rays, 48, 40), "deep tiles of 48");
  }
  // The measure tells scenes apart: the canyon has about 1 % of such tiles.
  Scene canyon = make_scene("canyon");
  expect_in(describe_scene("canyon").wanted.number("deep_tiles_of_16"),
            deep_tiles(canyon, RayCaster(canyon), 16, 50), "the canyon's deep tiles of 16");
}

}  // namespace
}  // namespace ml
