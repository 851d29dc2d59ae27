// Small levels drawn by lot, compared with the double-precision oracle: no false alarm at any point, and no
// error that the tolerance would hide.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/bench/case_pictures.h"
#include "harness/bench/picture_proof.h"
#include "tests/hard_cases/random_frames.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 24, height = 18;

// A floor with some boxes in materials between mirrors and chalk.
Scene random_level(Random& random) {
  HandMadeScene made;
  std::vector<uint32_t> materials;
  for (int i = 0; i < 4; ++i) {
    Material material;
    material.base_color = {random.uniform(), random.uniform(), random.uniform(), 1};
    material.roughness = random.below(3) ? random.uniform() : 0;
    material.metallic = random.below(2) ? random.uniform() : 0;
    materials.push_back(made.material(material));
  }
  const float side = log_uniform(random, 1, 500);
  made.rectangle({-side / 2, 0, side / 2}, {side, 0, 0}, {0, 0, -side}, materials[0]);
  for (uint32_t i = random.below(12); i > 0; --i) {
    const glm::vec3 low(random.uniform(-0.5f, 0.5f) * side, random.uniform(-0.1f, 0.2f) * side,
                        random.uniform(-0.5f, 0.5f) * side);
    const glm::vec3 size(random.uniform(0.01f, 0.3f), random.uniform(0.01f, 0.3f),
                         random.uniform(0.01f, 0.3f));
    made.box(low, low + size * side, materials[random.below(4)]);
  }
  return made.finish();
}

// Looks at the level from above its floor.
Camera random_view(Random& random, const Scene& scene) {
  const double side = static_cast<double>(scene.bounds.size().x);
  const glm::dvec3 eye = side * glm::dvec3(static_cast<double>(random.uniform(-0.6f, 0.6f)),
                                           static_cast<double>(random.uniform(0.01f, 0.5f)),
                                           static_cast<double>(random.uniform(-0.6f, 0.6f)));
  const glm::dvec3 target =
      0.3 * side *
      glm::dvec3(static_cast<double>(random.uniform(-1, 1)), 0, static_cast<double>(random.uniform(-1, 1)));
  return camera_at(eye, target, width, height, static_cast<float>(1e-3 * side), static_cast<float>(4 * side));
}

// One to eighty lights of all shapes, as large as hairs and as the level; some cones have next to no soft
// edge.
std::vector<Light> random_level_lights(Random& random, const Scene& scene) {
  const glm::dvec3 low(scene.bounds.min), size(scene.bounds.size());
  const float side = scene.bounds.size().x;
  std::vector<Light> lights =
      mixed_shapes(1 + random.below(80), low, low + size + glm::dvec3(0, 0.3 * size.x, 0), 1e-3f * side,
                   0.7f * side, random.next());
  for (Light& light : lights)
    if (has_cone(light.shape) && random.below(3) == 0)
      light.inner_angle = light.outer_angle * (1 - log_uniform(random, 1e-7f, 1));
  return lights;
}

class RandomLevels : public HardCases {
 public:
  // Levels with numbers [first, first + count).
  void expect_no_false_alarm(uint32_t first, uint32_t count) {
    uint64_t contributing = 0;
    for (uint32_t number = first; number < first + count && !HasFailure(); ++number) {
      SCOPED_TRACE(number);
      Random random(hash_u32(77, number));
      const Scene scene = random_level(random);
      const Camera camera = random_view(random, scene);
      Exactness check(scene, width, height, all_shapes());
      const Seen seen = check.expect_trials(camera, random_level_lights(random, scene), {}, 0);
      contributing += seen.contributing();
      OracleFrame oracle(check.frame(), check.input());
      PictureJudge judge(oracle, true, seen.truth.count);
      PictureProof proof;
      for (size_t pixel = 0; pixel < seen.lit.size(); ++pixel) {
        if (!seen.lit[pixel]) continue;
        const OracleAnswer& answer = judge.answer(pixel);
        const uint32_t count_here = seen.truth.count[pixel];
        EXPECT_LE(std::max(count_here, answer.contributing) - std::min(count_here, answer.contributing),
                  answer.marginal)
            << "pixel " << pixel;
        judge.against_truth(seen.image, pixel, proof);
      }
      EXPECT_EQ(proof.wrong, 0u) << proof.evidence("points");
      worst_ = std::max(worst_, proof.worst_ratio);
    }
    EXPECT_GT(contributing, uint64_t{count} * width * height / 2)
        << "the levels are too dark to mean anything";
    RecordProperty("largest_ratio", std::to_string(worst_));
  }

 private:
  double worst_ = 0;
};

TEST_F(RandomLevels, RaiseNoFalseAlarm) {
  expect_no_false_alarm(0, 12);
}

// Some minutes: for changes of the oracle's tolerance (--gtest_also_run_disabled_tests).
TEST_F(RandomLevels, DISABLED_RaiseNoFalseAlarmInAThousand) {
  expect_no_false_alarm(0, 1000);
}

// A light of a level is a ten-thousandth brighter than it should be.
TEST_F(RandomLevels, APlantedErrorIsFound) {
  const Scene scene = floor_at({0, 0, -8}, 20);
  std::vector<Light> lights{omni({-2, 3, -8}, 9, 20), omni({2, 3, -9}, 9, 20), omni({0, 2, -6}, 7, 20)};
  const Camera camera = camera_at({0, 2, 0}, {0, 0, -8}, width, height);
  Exactness check(scene, width, height, all_shapes());
  const Seen right = check.expect_trials(camera, lights, {}, 0);
  const OracleFrame oracle(check.frame(), check.input());
  lights[0].intensity *= 1.0001f;
  const Seen wrong = check.expect_trials(camera, lights, {}, 0);
  PictureJudge judge(oracle, true, right.truth.count);
  PictureProof of_right, of_wrong;
  uint32_t points = 0;
  for (size_t pixel = 0; pixel < right.lit.size(); ++pixel) {
    if (!right.lit[pixel] || right.truth.count[pixel] < 3) continue;
    ++points;
    judge.against_truth(right.image, pixel, of_right);
    judge.against_truth(wrong.image, pixel, of_wrong);
  }
  EXPECT_EQ(of_right.wrong, 0u) << of_right.evidence("points");
  EXPECT_GT(points, 20u);
  EXPECT_GT(of_wrong.wrong, points / 4) << of_wrong.evidence("points");
}

}  // namespace
}  // namespace ml::test
