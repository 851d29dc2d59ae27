// Fine pruned tile lists: nothing lost where nothing may be, and what the chapter's limits lose is what is
// reported.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/accuracy/image_metrics.h"
#include "tests/hard_cases/pruned_check.h"
#include "tests/hard_cases/random_frames.h"

namespace ml::test {
namespace {

const PrunedSettings paper{"paper", "fine", "subgroup"};

// As shaders/light_eval.glsl has it.
uint32_t light_hash(uint32_t index) {
  const uint32_t state = index * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

Camera above_floor(uint32_t width, uint32_t height) {
  return camera_at({0, 3, 0}, {0, 0, 0}, width, height);
}

// Reaches every point of the floor below above_floor(), in any shape.
Light everywhere(uint32_t shape) {
  const glm::dvec3 at(0, 2, 0);
  switch (shape % 5) {
    case 0:
      return box(at, {0, -1, 0}, {1, 0, 0}, {50, 50, 50});
    case 1:
      return wedge(spot(at, 90, {0, -1, 0}, 80, 89.9f), {1, 0, 0}, 40);
    case 2:
      return capsule(at, 80, {1, 0, 0}, 3);
    case 3:
      return spot(at, 90, {0, -1, 0}, 170, 179);
    default:
      return omni(at, 60, 1e-2f);
  }
}

void expect_random_frames(uint32_t width, uint32_t height, uint32_t cases, uint32_t seed) {
  PrunedCheck check(yard(), width, height);
  for_random_frames(
      width, height, cases, seed, [&](Random&, const Camera& camera, const std::vector<Light>& lights) {
        check.load(camera, lights);
        check.expect_lossless();
        const uint64_t contributing = check.contributing();
        // With the chapter's limits a frame loses lights only when it says so, and the same ones every time.
        const PrunedRun first = check.run(paper), second = check.run(paper);
        EXPECT_TRUE(first.frame.lost == 0 || first.frame.prepare.overflow_lights > 0);
        EXPECT_TRUE(first.frame.prepare.overflow_lights > 0 || first.frame.mismatched_pixels == 0);
        EXPECT_TRUE(first.counts.listed == second.counts.listed && first.counts.hash == second.counts.hash);
        EXPECT_EQ(compare_images(first.image, second.image).differing_bits, 0u);
        return contributing;
      });
}

TEST_F(HardCases, FinePruned_RandomFramesOfAnOrdinaryPicture) {
  expect_random_frames(64, 36, 120, 11);
}

TEST_F(HardCases, FinePruned_RandomFramesOfAnOddPicture) {
  expect_random_frames(37, 53, 120, 12);
}

TEST_F(HardCases, FinePruned_RandomFramesOfATinyPicture) {
  expect_random_frames(5, 3, 100, 13);
}

TEST_F(HardCases, FinePruned_RandomFramesOfOnePixel) {
  expect_random_frames(1, 1, 100, 14);
}

TEST_F(HardCases, FinePruned_CountsAroundChunksAndBatches) {
  PrunedCheck check(floor_at({0, 0, 0}, 100), 20, 18);
  for (uint32_t count :
       {0u, 1u, 2u, 31u, 32u, 33u, 63u, 64u, 65u, 127u, 128u, 511u, 512u, 513u, 1000u, 1024u, 1600u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    std::vector<Light> lights;
    for (uint32_t i = 0; i < count; ++i) lights.push_back(everywhere(i));
    check.load(above_floor(20, 18), lights);
    EXPECT_EQ(check.truth().count, std::vector<uint32_t>(20 * 18, count));
    check.expect_lossless();
    const PrunedRun run = check.run({});
    EXPECT_EQ(run.counts.listed, std::vector<uint32_t>(20 * 18, count));
    EXPECT_EQ(run.frame.prepare.coarse_lights, count);
    EXPECT_EQ(run.frame.prepare.fine_lights, count);
  }
}

TEST_F(HardCases, FinePruned_SixtyFiveThousandLightsInOneTile) {
  PrunedCheck check(floor_at({0, 0, 0}, 100), 8, 8, all_shapes(true));
  for (uint32_t count : {65535u, 65536u, 65537u, 100000u, 170000u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    std::vector<Light> lights(count, omni({0, 2, 0}, 50, 1e-3f));
    for (uint32_t i = 0; i < count; i += 3) lights[i] = spot({0, 2, 0}, 50, {0, -1, 0}, 80, 89);
    check.load(above_floor(8, 8), lights);
    for (const PrunedSettings& settings : {PrunedSettings{}, PrunedSettings{"exact", "coarse", "pixel"}}) {
      const PrunedRun run = check.run(settings);
      EXPECT_EQ(run.counts.contributing, std::vector<uint32_t>(64, count)) << settings.text();
      EXPECT_EQ(run.frame.lost, 0u);
      EXPECT_EQ(run.frame.mismatched_pixels, 0u);
    }
  }
}

// The smaller ball around such a spot reaches 1.4 times its radius towards the camera, and would cover 2.6
// times the tiles that the CPU makes space for.
TEST_F(HardCases, FinePruned_SpotsThatPointAtTheCameraFitTheCapacityOfTheirLists) {
  constexpr uint32_t size = 160;
  PrunedCheck check(floor_at({0, 0, 0}, 100), size, size);
  Projection wide;
  wide.left = wide.bottom = -2;
  wide.right = wide.top = 2;
  const std::vector<Light> lights(400, spot({0, 0.5, 0}, 1.5625f, {0, 1, 0}, 44, 45));
  check.load(Camera::look_at({0, 3, 0}, {0, 0, 1e-3}, wide), lights);
  const PrunedRun run = check.run({"exact", "coarse", "subgroup", "ball", false});
  const auto walked = std::ranges::count(run.counts.listed, lights.size());
  EXPECT_EQ(std::ranges::count(run.counts.listed, 0u) + walked, size * size);
  // Slope 0.8 of 2 to each side, and the tiles that are met in part.
  EXPECT_GE(walked, size * size * 16 / 100);
  EXPECT_LE(walked, size * size * 36 / 100);
}

TEST_F(HardCases, FinePruned_SixtyFiveThousandLightsOfAllShapes) {
  PrunedCheck check(yard(), 40, 23, all_shapes(true));
  check.load(camera_at({0, 3, 14}, {0, 1, -10}, 40, 23),
             mixed_shapes(65536, {-30, -1, -40}, {30, 12, 14}, 0.1f, 3, 26));
  check.expect_lossless();
  EXPECT_GT(check.contributing(), 1000u);
}

TEST_F(HardCases, FinePruned_CameraInsideLights) {
  PrunedCheck check(yard(), 50, 30);
  std::vector<Light> lights;
  const glm::dvec3 eye(0, 3, 14);
  for (float size : {0.2f, 3.0f, 100.0f, 1e5f})
    for (glm::vec3 axis :
         {glm::vec3(0, -1, -1), glm::vec3(0, 0, 1), glm::vec3(1, 0.1f, 0), glm::vec3(0, -1, 0)}) {
      lights.push_back(omni(eye, size));
      lights.push_back(spot(eye, size, axis, 10, 30));
      lights.push_back(spot(eye - 0.05 * glm::dvec3(axis), size, axis, 60, 100));
      lights.push_back(capsule(eye, size, axis, size));
      lights.push_back(wedge(spot(eye, size, axis, 5, 40), {0.3f, 1, 0.7f}, size));
      lights.push_back(box(eye, axis, {0.3f, 1, 0.7f}, {size, 2 * size, 0.5f * size}));
      // The eye just within and just outside the hull's faces.
      for (float part : {0.999999f, 1.0f, 1.000001f})
        lights.push_back(box(eye + glm::dvec3(0, 0, static_cast<double>(size * part)), {0, 0, 1}, {1, 0, 0},
                             {size, size, size}));
    }
  check.load(camera_at(eye, {0, 1, -10}, 50, 30), lights);
  check.expect_lossless();
  EXPECT_GT(check.contributing(), 0u);
}

TEST_F(HardCases, FinePruned_ManySmallHulls) {
  // So many that faces, edges and corners of the hulls fall on the edges of tiles, where bounds a few percent
  // too small would show. Cones up to where they are no longer narrowed, and a little beyond.
  PrunedCheck check(yard(), 320, 180);
  Random random(77);
  std::vector<Light> lights;
  for (uint32_t i = 0; i < 4000; ++i) {
    const glm::dvec3 at(static_cast<double>(random.uniform(-14, 14)),
                        static_cast<double>(random.uniform(0, 3)),
                        static_cast<double>(random.uniform(-12, 11)));
    const glm::vec3 axis(random.uniform(-1, 1), random.uniform(-2, -0.3f), random.uniform(-1, 1));
    const Light cone = spot(at, random.uniform(2, 6), axis, 1, random.uniform(5, 58));
    const glm::vec3 size(random.uniform(0.2f, 2), random.uniform(0.2f, 2), random.uniform(0.2f, 2));
    switch (i % 5) {
      case 0:
        lights.push_back(box(at, axis, {1, 0, 0}, size));
        break;
      case 1:
        lights.push_back(capsule(at, size.x, axis, size.y));
        break;
      case 2:
        lights.push_back(wedge(cone, {1, 0, 0}, size.x));
        break;
      default:
        lights.push_back(cone);
    }
  }
  check.load(camera_at({0, 3, 14}, {0, 1, -10}, 320, 180), lights);
  check.expect_lossless();
  EXPECT_GT(check.contributing(), 320u * 180u);
}

TEST_F(HardCases, FinePruned_SkyAlone) {
  PrunedCheck check(floor_at({0, 0, 0}, 4), 33, 20);
  check.load(camera_at({0, 5, 0}, {0, 9, -1}, 33, 20), std::vector<Light>(100, omni({0, 6, 0}, 50)));
  const PrunedRun run = check.run({});
  EXPECT_EQ(run.frame.lit_pixels, 0u);
  EXPECT_EQ(run.frame.prepare.coarse_lights, 0);
  EXPECT_EQ(run.frame.prepare.fine_lights, 0);
}

TEST_F(HardCases, FinePruned_LossIsWhatIsReported) {
  constexpr uint32_t width = 40, height = 20, pixels = width * height, tiles = 6;
  PrunedCheck check(floor_at({0, 0, 0}, 100), width, height);
  for (uint32_t count : {0u, 5u, 23u, 24u, 25u, 64u, 65u, 100u, 1024u, 1030u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    std::vector<Light> lights;
    for (uint32_t i = 0; i < count; ++i) lights.push_back(everywhere(i));
    check.load(above_floor(width, height), lights);
    const PrunedRun run = check.run(paper);
    const uint32_t visible = std::min(count, 1024u), coarse = std::min(visible, 64u),
                   fine = std::min(coarse, 24u);
    EXPECT_EQ(run.frame.lost, uint64_t{pixels} * (count - fine));
    EXPECT_EQ(run.frame.prepare.overflow_lights,
              (count - visible) + uint64_t{tiles} * ((visible - coarse) + (coarse - fine)));
    EXPECT_EQ(run.frame.prepare.overflow_tiles, visible > fine ? tiles : 0);
    EXPECT_EQ(run.frame.prepare.fine_lights, fine);
    EXPECT_EQ(run.frame.prepare.list_bytes, 32 + 4 * uint64_t{visible} + 2 * 32 * tiles);
    // The first ones are kept: balls, then cones, then boxes, each by index.
    uint32_t hash = 0, kept = 0;
    for (auto type : {std::set<uint32_t>{2, 4}, {1, 3}, {0}})
      for (uint32_t i = 0; i < count && kept < fine; ++i)
        if (type.count(i % 5)) hash += light_hash(i), ++kept;
    EXPECT_EQ(run.counts.hash, std::vector<uint32_t>(pixels, hash));
  }
}

TEST_F(HardCases, FinePruned_ProbeLightsHaveAListOfTheirOwn) {
  constexpr uint32_t width = 40, height = 20, pixels = width * height, tiles = 6;
  PrunedCheck check(floor_at({0, 0, 0}, 100), width, height);
  const std::pair<uint32_t, uint32_t> mixes[] = {{30, 30}, {24, 24}, {25, 24}, {10, 40}, {0, 30}, {0, 64},
                                                 {31, 33}, {32, 32}, {33, 31}, {60, 10}, {64, 5}, {500, 600}};
  for (const auto& [direct, probes] : mixes) {
    SCOPED_TRACE(fmt::format("{} direct and {} probe lights", direct, probes));
    // Probe lights first: the lists are by what lights are, not by where they stand.
    std::vector<Light> lights;
    for (uint32_t i = 0; i < direct + probes; ++i) {
      lights.push_back(everywhere(i));
      lights.back().probe = i < probes;
    }
    check.load(above_floor(width, height), lights);
    EXPECT_EQ(check.truth().count, std::vector<uint32_t>(pixels, direct + probes));
    check.expect_lossless();
    const uint32_t all = direct + probes, visible = std::min(all, 1024u);
    const uint32_t coarse_direct = std::min(direct, 64u), coarse = std::min(visible, 64u),
                   coarse_probes = std::min(probes, coarse - coarse_direct);
    const uint32_t fine_direct = std::min(coarse_direct, 24u), fine_probes = std::min(coarse_probes, 24u);
    for (const char* walk : {"subgroup", "pixel"}) {
      const PrunedRun run = check.run({"paper", "fine", walk});
      EXPECT_EQ(run.counts.listed, std::vector<uint32_t>(pixels, fine_direct + fine_probes));
      EXPECT_EQ(run.frame.lost, uint64_t{pixels} * (all - fine_direct - fine_probes));
      EXPECT_EQ(run.frame.prepare.overflow_lights,
                (all - visible) + uint64_t{tiles} * (visible - fine_direct - fine_probes));
      EXPECT_EQ(run.frame.prepare.list_bytes, 32 + 4 * uint64_t{visible} + 2 * 32 * tiles);
      // The first ones of each kind are kept: balls, then cones, then boxes, each by index.
      uint32_t hash = 0;
      for (bool probe : {false, true}) {
        uint32_t kept = 0;
        for (auto type : {std::set<uint32_t>{2, 4}, {1, 3}, {0}})
          for (uint32_t i = 0; i < all; ++i)
            if (lights[i].probe == probe && type.count(i % 5) && kept < (probe ? fine_probes : fine_direct))
              hash += light_hash(i), ++kept;
      }
      EXPECT_EQ(run.counts.hash, std::vector<uint32_t>(pixels, hash));
    }
  }
}

TEST_F(HardCases, FinePruned_WithoutProbeLightsThereIsOneListATile) {
  constexpr uint32_t width = 40, height = 20, tiles = 6;
  FrameOptions options = all_shapes();
  options.effects.probes = false;
  PrunedCheck check(floor_at({0, 0, 0}, 100), width, height, options);
  std::vector<Light> lights;
  for (uint32_t i = 0; i < 30; ++i) lights.push_back(everywhere(i));
  check.load(above_floor(width, height), lights);
  const PrunedRun run = check.run(paper);
  EXPECT_EQ(run.counts.listed, std::vector<uint32_t>(width * height, 24));
  EXPECT_EQ(run.frame.prepare.list_bytes, 32 + 4 * uint64_t{30} + 32 * tiles);
}

}  // namespace
}  // namespace ml::test
