// Random cameras, lights, algorithms and parameters: exactly the lights of brute force are evaluated, at
// every pixel of every case.
#include "tests/hard_cases/random_frames.h"

namespace ml::test {
namespace {

void expect_random_cases(uint32_t width, uint32_t height, uint32_t cases, uint32_t seed) {
  Effects effects = all_shapes();
  effects.texel_fetch = width % 2 == 0;
  effects.any_subgroup_size = height % 2 != 0;
  effects.test_ahead = width % 3 == 1;
  Exactness check(yard(), width, height, effects);
  for_random_frames(width, height, cases, seed,
                    [&](Random& random, const Camera& camera, const std::vector<Light>& lights) {
                      const std::vector<Trial> trials{random_trial(random, width, height),
                                                      random_trial(random, width, height)};
                      return check.expect_trials(camera, lights, trials, 0).contributing();
                    });
}

TEST_F(HardCases, RandomCasesOfAnOrdinaryPicture) {
  expect_random_cases(64, 36, 250, 1);
}

TEST_F(HardCases, RandomCasesOfAnOddPicture) {
  expect_random_cases(37, 53, 250, 2);
}

TEST_F(HardCases, RandomCasesOfATinyPicture) {
  expect_random_cases(5, 3, 250, 3);
}

}  // namespace
}  // namespace ml::test
