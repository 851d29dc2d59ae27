// What lists fine_pruned builds: the lights that the tiles' pixels lie in, and how many more by bounds alone.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/hard_cases/pruned_check.h"
#include "tests/hard_cases/random_frames.h"

namespace ml::test {
namespace {

// A light's volume in double precision, larger or smaller by a factor: is the point in it?
bool holds(const Light& light, const glm::dvec3& point, double factor) {
  const glm::dvec3 from = point - light.position;
  if (light.shape == LightShape::box) {
    const glm::dvec3 front(light.direction), side(light.side);
    return std::abs(glm::dot(from, side)) < factor * static_cast<double>(light.half_extents.x) &&
           std::abs(glm::dot(from, glm::cross(front, side))) <
               factor * static_cast<double>(light.half_extents.y) &&
           std::abs(glm::dot(from, front)) < factor * static_cast<double>(light.half_extents.z);
  }
  glm::dvec3 nearest = from;
  if (has_segment(light.shape)) {
    const double half = static_cast<double>(light.half_length);
    nearest -= std::clamp(glm::dot(from, glm::dvec3(light.side)), -half, half) * glm::dvec3(light.side);
  }
  const double distance = glm::length(nearest);
  if (!(distance < factor * static_cast<double>(light.radius))) return false;
  if (!has_cone(light.shape)) return true;
  const double angle =
      std::acos(std::clamp(glm::dot(nearest, glm::dvec3(light.direction)) / distance, -1.0, 1.0));
  return angle < static_cast<double>(light.outer_angle) + (factor - 1);
}

// Cosine of the angle between the normal and the way to the light's source; 1 on the source.
double facing(const Light& light, const glm::dvec3& point, const glm::dvec3& normal) {
  glm::dvec3 source = light.position;
  if (has_segment(light.shape)) {
    const double half = static_cast<double>(light.half_length);
    const glm::dvec3 side(light.side);
    source += std::clamp(glm::dot(point - source, side), -half, half) * side;
  }
  const double distance = glm::length(source - point);
  return distance > 1e-6 ? glm::dot(normal, source - point) / distance : 1;
}

TEST_F(HardCases, FinePruned_ListsHoldWhatTheTilesPixelsLieIn) {
  // A room of narrow spots under its ceiling, lamps and boxes.
  constexpr uint32_t width = 200, height = 120;
  PrunedCheck check(yard(), width, height);
  const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, width, height);
  std::vector<Light> lights;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 at((i % 20) * 2 - 20, 3 + i % 4, 10 - (i / 20) * 2);
    switch (i % 5) {
      case 0:
        lights.push_back(omni(at, 4));
        break;
      case 1:
        lights.push_back(capsule(at, 3.3f, {1, 0.2f, 0.1f}, 2));
        break;
      case 2:
        lights.push_back(box(at, {0.2f, -1, 0.3f}, {1, 0, 0}, {1, 2, 4}));
        break;
      case 3:
        lights.push_back(wedge(spot(at, 8, {0.2f, -1, 0}, 10, 20), {0, 0, 1}, 1.5f));
        break;
      default:
        lights.push_back(spot(at, 9, {0.3f, -1, 0.2f * static_cast<float>(i % 3)}, 5, 15));
    }
  }
  check.load(camera, lights);
  const std::vector<float> positions = check.frame().read_aov(DeviceFrame::Aov::position);
  const std::vector<float> normals = check.frame().read_aov(DeviceFrame::Aov::normal);
  std::vector<std::set<size_t>> surely(check.tiles()), perhaps(check.tiles());
  // And those that such a pixel faces.
  std::vector<std::set<size_t>> surely_faced(check.tiles()), perhaps_faced(check.tiles());
  for (size_t pixel = 0; pixel < width * height; ++pixel) {
    const float* at = &positions[4 * pixel];
    if (!(at[3] > 0)) continue;
    const glm::dvec3 point = glm::dvec3(camera.position) + glm::dvec3(glm::vec3(at[0], at[1], at[2]));
    for (size_t i = 0; i < lights.size(); ++i) {
      if (!holds(lights[i], point, 1 + 1e-3)) continue;
      const bool sure = holds(lights[i], point, 1 - 1e-3);
      const double cosine = facing(
          lights[i], point, glm::dvec3(normals[4 * pixel], normals[4 * pixel + 1], normals[4 * pixel + 2]));
      const uint32_t tile = check.tile_of(pixel);
      perhaps[tile].insert(i);
      if (cosine > -1e-3) perhaps_faced[tile].insert(i);
      if (sure) surely[tile].insert(i);
      if (sure && cosine > 1e-3) surely_faced[tile].insert(i);
    }
  }
  const PrunedRun fine = check.run({}), coarse = check.run({"exact", "coarse", "pixel"});
  const PrunedRun faced = check.run({"exact", "facing", "subgroup"});
  double low = 0, high = 0;
  for (uint32_t tile = 0; tile < check.tiles(); ++tile) {
    low += static_cast<double>(surely[tile].size()) / check.tiles();
    high += static_cast<double>(perhaps[tile].size()) / check.tiles();
  }
  for (size_t pixel = 0; pixel < width * height; ++pixel) {
    if (!(positions[4 * pixel + 3] > 0)) continue;
    ASSERT_GE(fine.counts.listed[pixel], surely[check.tile_of(pixel)].size()) << "pixel " << pixel;
    ASSERT_LE(fine.counts.listed[pixel], perhaps[check.tile_of(pixel)].size()) << "pixel " << pixel;
    ASSERT_LE(fine.counts.listed[pixel], coarse.counts.listed[pixel]) << "pixel " << pixel;
    ASSERT_GE(faced.counts.listed[pixel], surely_faced[check.tile_of(pixel)].size()) << "pixel " << pixel;
    ASSERT_LE(faced.counts.listed[pixel], perhaps_faced[check.tile_of(pixel)].size()) << "pixel " << pixel;
  }
  EXPECT_GE(fine.frame.prepare.fine_lights, low - 1e-9);
  EXPECT_LE(fine.frame.prepare.fine_lights, high + 1e-9);
  EXPECT_LT(faced.frame.prepare.fine_lights, 0.99 * fine.frame.prepare.fine_lights);
  // Pruning has something to do here, and the coarse lists are not everything in view.
  EXPECT_LT(fine.frame.prepare.fine_lights, 0.8 * fine.frame.prepare.coarse_lights);
  EXPECT_EQ(coarse.frame.prepare.fine_lights, coarse.frame.prepare.coarse_lights);
  EXPECT_LT(coarse.frame.prepare.coarse_lights, 0.5 * static_cast<double>(coarse.frame.prepare.in_frustum));
}

// Regions only find sooner what tiles would have found: the same lists, so the same bits.
TEST_F(HardCases, FinePruned_RegionsChangeNothing) {
  // 3 x 2 regions, most of them partial.
  constexpr uint32_t width = 290, height = 150;
  FrameOptions options = all_shapes();
  options.effects.probes = true;
  PrunedCheck check(yard(), width, height, options);
  const PrunedSettings ways[] = {
      {}, {"paper"}, {"exact", "coarse", "subgroup", "hull", false}, {"exact", "fine", "pixel", "ball"}};
  for_random_frames(width, height, 6, 16,
                    [&](Random& random, const Camera& camera, std::vector<Light> lights) {
                      for (Light& light : lights) light.probe = random.below(3) == 0;
                      check.load(camera, lights);
                      for (PrunedSettings way : ways) {
                        SCOPED_TRACE(way.text());
                        const PrunedRun flat = check.run(way);
                        way.region_lights = 0;
                        const PrunedRun regions = check.run(way);
                        EXPECT_EQ(regions.image.data, flat.image.data);
                        EXPECT_EQ(regions.counts.listed, flat.counts.listed);
                        EXPECT_EQ(regions.frame.prepare.coarse_lights, flat.frame.prepare.coarse_lights);
                        EXPECT_EQ(regions.frame.prepare.fine_lights, flat.frame.prepare.fine_lights);
                        EXPECT_EQ(regions.frame.prepare.overflow_lights, flat.frame.prepare.overflow_lights);
                        if (way.caps == "exact") {
                          EXPECT_EQ(regions.frame.lost, 0u);
                        }
                      }
                      return check.contributing();
                    });
}

// Bounds that are wider, or of fewer dimensions, list more lights; pruning leaves the same of them.
TEST_F(HardCases, FinePruned_WiderBoundsListMore) {
  struct Bounds {
    const char* word;
    bool tile_depths;
    double coarse;  // sum over all frames
  };
  Bounds all[] = {{"hull", true, 0},  {"box", true, 0},  {"ball", true, 0},
                  {"hull", false, 0}, {"box", false, 0}, {"ball", false, 0}};
  constexpr uint32_t width = 80, height = 50;
  PrunedCheck check(yard(), width, height);
  for_random_frames(width, height, 40, 15,
                    [&](Random&, const Camera& camera, const std::vector<Light>& lights) {
                      check.load(camera, lights);
                      const PrunedRun fine = check.run({});
                      for (Bounds& each : all) {
                        const PrunedSettings wide{"exact", "fine", "subgroup", each.word, each.tile_depths};
                        SCOPED_TRACE(wide.text());
                        const PrunedRun run = check.run(wide);
                        EXPECT_EQ(run.frame.lost, 0u);
                        EXPECT_EQ(run.frame.mismatched_pixels, 0u);
                        // A straight box may be the better hull of a wide cone.
                        if (wide.bounds != "box") {
                          EXPECT_GE(run.frame.prepare.coarse_lights, fine.frame.prepare.coarse_lights);
                        }
                        // But for a light whose volume, widened by rounding's due, leaves its hull.
                        EXPECT_NEAR(run.frame.prepare.fine_lights, fine.frame.prepare.fine_lights,
                                    1e-3 * fine.frame.prepare.coarse_lights);
                        each.coarse += run.frame.prepare.coarse_lights;
                      }
                      return check.contributing();
                    });
  for (int i = 0; i < 6; ++i) {
    if (i % 3 > 0) {
      EXPECT_GT(all[i].coarse, all[i - 1].coarse) << i;
    }
    if (i >= 3) {
      EXPECT_GT(all[i].coarse, 1.02 * all[i - 3].coarse) << i;
    }
  }
}

}  // namespace
}  // namespace ml::test
