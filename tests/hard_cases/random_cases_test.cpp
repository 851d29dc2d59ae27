// Random cameras, lights, algorithms and parameters: exactly the lights of brute force are evaluated, at
// every pixel of every case.
#include <fmt/format.h>

#include "tests/hard_cases/random_frames.h"

namespace ml::test {
namespace {

void expect_random_cases(uint32_t width, uint32_t height, uint32_t cases, uint32_t seed) {
  Exactness check(yard(), width, height, all_shapes());
  uint64_t contributing = 0;
  for (uint32_t number = 0; number < cases && !testing::Test::HasFailure(); ++number) {
    SCOPED_TRACE(fmt::format("{}x{}, seed {}, case {}", width, height, seed, number));
    Random random(hash_u32(seed, number));
    const Camera camera = random_camera(random, width, height);
    const std::vector<Light> lights = random_lights(random, camera);
    contributing +=
        check
            .expect_trials(camera, lights,
                           {random_trial(random, width, height), random_trial(random, width, height)}, 0)
            .contributing();
  }
  EXPECT_GT(contributing, uint64_t{cases} * width * height / 20)
      << "the cases are too empty to mean anything";
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
