// Lists whose lengths, rows and depths are what index arithmetic is most often written without.
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

// Every algorithm at its defaults, and the grids with every way of narrowing their lists.
std::vector<Trial> all_with(const std::vector<GridSettings>& grids) {
  std::vector<Trial> trials = every_algorithm();
  for (Trial& trial : trials_of(grids)) trials.push_back(std::move(trial));
  return trials;
}

TEST_F(HardCases, Case51_CountsAroundThoseOf8And16BitsInOneFroxel) {
  // Every light reaches every pixel, and all of these lie in the only tile and slice: its list holds them
  // all.
  Exactness check(floor_at({0, 0, 0}, 100), 6, 4, {.effects = {.spots = true}, .many_lights = true});
  const Camera above = camera_at({0, 3, 0}, {0, 0, 0}, 6, 4);
  for (uint32_t count : {255u, 256u, 257u, 65535u, 65536u, 65537u}) {
    SCOPED_TRACE(testing::Message() << count << " lights");
    const std::vector<Light> lights = scattered(count, {-1, 1, -0.6}, {1, 2, 0.6}, 15, 20, 51, 0);
    const Seen seen = check.expect_trials(above, lights,
                                          all_with({{.tile = 16, .slices = 1},
                                                    {.tile = 16, .slices = 1, .ball_test = true},
                                                    {.tile = 16, .slices = 1, .refinement = true},
                                                    {.tile = 16, .slices = 1, .refinement = true}}),
                                          1);
    EXPECT_EQ(seen.truth.count, std::vector<uint32_t>(24, count));
  }
}

TEST_F(HardCases, Case52_LightsBeyondTheFarDepth) {
  // Lights reach back to surfaces before the far depth, in no order of depth.
  Exactness check(yard(), 64, 36);
  const std::vector<Light> lights = scattered(400, {-30, -1, -90}, {30, 12, -20}, 5, 40, 52, 5);
  for (float far : {30.0f, 60.0f})
    check.expect_trials(camera_at({0, 3, 14}, {0, 1, -10}, 64, 36, 0.1f, far), lights,
                        all_with({{.tile = 16}, {.tile = 16, .ball_test = true}}), 4);
}

TEST_F(HardCases, Case53_RowsAndListsOfNoPowerOfTwo) {
  // 37 x 5 tiles, the last ones partial, with 40 lights in every one.
  constexpr uint32_t width = 37 * 8 - 3, height = 5 * 8 - 1;
  Exactness check(floor_at({0, 0, 0}, 100), width, height);
  const Camera above = camera_at({0, 3, 0}, {0, 0, 0}, width, height);
  const std::vector<Light> lights = scattered(40, {-2, 1, -1}, {2, 2, 1}, 40, 60, 53, 0);
  const Seen seen = check.expect_trials(above, lights,
                                        all_with({{.tile = 8},
                                                  {.tile = 8, .refinement = true},
                                                  {.tile = 8, .ball_test = true},
                                                  {.tile = 8, .slices = 3}}),
                                        4);
  EXPECT_EQ(seen.truth.count, std::vector<uint32_t>(width * height, 40));
}

}  // namespace
}  // namespace ml::test
