// Random cameras, lights, algorithms and parameters: exactly the lights of brute force are evaluated, at
// every pixel of every case.
#include <fmt/format.h>

#include "tests/hard_cases/random_frames.h"
#include "tests/support/drivers.h"

namespace ml::test {
namespace {

// One test each, so that none takes long.
struct Part {
  const char* name;
  uint32_t width, height, cases, seed;
  uint32_t max_lights;
};

void PrintTo(const Part& part, std::ostream* out) {
  *out << fmt::format("{}x{} px, {} cases of up to {} lights, seed {}", part.width, part.height, part.cases,
                      part.max_lights, part.seed);
}

// Every process compiles its programs anew on a driver that keeps none: a few parts are enough there, and of those
// with many lights, which take a minute each, one of a kind.
bool is_thinned(const Part& part) {
  const uint32_t kept = part.max_lights > max_lights_of_short_passes ? 1 : 3;
  return on_swiftshader() && part.seed % 100 > kept;
}

class RandomCases : public HardCases, public testing::WithParamInterface<Part> {};

TEST_P(RandomCases, EvaluateTheLightsOfBruteForce) {
  const Part& part = GetParam();
  if (is_thinned(part)) GTEST_SKIP() << "thinned on SwiftShader";
  FrameOptions options = all_shapes(part.max_lights > max_lights_of_short_passes);
  // Trees with a leaf a light need more nodes than the smallest texel buffers show.
  options.shading.texel_fetch =
      part.width % 2 == 0 && device().limits().texel_buffer_bytes >= (uint64_t{1} << 24);
  options.tests.any_subgroup_size = part.height % 2 != 0;
  options.shading.test_ahead = part.width % 3 == 1;
  Exactness check(yard(), part.width, part.height, options);
  for_random_frames(
      part.width, part.height, part.cases, part.seed,
      [&](Random& random, const Camera& camera, const std::vector<Light>& lights) {
        const std::vector<Trial> trials{random_trial(random, part.width, part.height),
                                        random_trial(random, part.width, part.height)};
        return check.expect_trials(camera, lights, trials, 0).contributing();
      },
      part.max_lights);
}

// Pictures that are usual, odd, and next to nothing.
std::vector<Part> few_lights() {
  std::vector<Part> parts;
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    parts.push_back({"Ordinary", 64, 36, 12, seed, 400});
    parts.push_back({"Odd", 37, 53, 12, 100 + seed, 400});
    parts.push_back({"Tiny", 5, 3, 12, 200 + seed, 400});
  }
  return parts;
}

// Whatever number of lights there is, up to beyond what 16 bits count.
std::vector<Part> many_lights() {
  std::vector<Part> parts;
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    parts.push_back({"Ordinary", 64, 36, 3, 300 + seed, 70'000});
    parts.push_back({"Tiny", 5, 3, 3, 400 + seed, 70'000});
  }
  return parts;
}

std::string name_of(const testing::TestParamInfo<Part>& info) {
  return fmt::format("{}{}", info.param.name, info.param.seed);
}

INSTANTIATE_TEST_SUITE_P(FewLights, RandomCases, testing::ValuesIn(few_lights()), name_of);
INSTANTIATE_TEST_SUITE_P(ManyLights, RandomCases, testing::ValuesIn(many_lights()), name_of);

}  // namespace
}  // namespace ml::test
