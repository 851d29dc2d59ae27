// How programs read lights and trees: from storage buffers and from texel buffers (shading.light_fetch),
// handed around small subgroups and not, tested ahead of shading and not (shading.test_ahead). The same bits.
#include <gtest/gtest.h>

#include "harness/accuracy/image_metrics.h"
#include "tests/hard_cases/hard_cases.h"
#include "tests/support/drivers.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 91, height = 67;

class LightFetch : public DeviceTest {};

FrameOptions fetched(bool texels, bool long_lists) {
  FrameOptions options = all_shapes(long_lists);
  options.effects.probes = true;
  options.shading.texel_fetch = texels;
  return options;
}

void expect_same(const Seen& one, const Seen& other) {
  ASSERT_EQ(one.counts.size(), other.counts.size());
  for (size_t i = 0; i < one.counts.size(); ++i) {
    SCOPED_TRACE(every_algorithm()[i].text());
    EXPECT_EQ(one.counts[i].tested, other.counts[i].tested);
    EXPECT_EQ(one.counts[i].nodes, other.counts[i].nodes);
    EXPECT_EQ(one.counts[i].hash, other.counts[i].hash);
    EXPECT_EQ(compare_images(one.pictures[i], other.pictures[i]).differing_bits, 0u);
  }
  EXPECT_EQ(compare_images(one.image, other.image).differing_bits, 0u) << "brute force";
}

TEST_F(LightFetch, BothWaysGiveTheSameBitsWithEveryAlgorithm) {
  const Camera camera = camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
  std::vector<Light> lights = mixed_shapes(300, {-25, 0, -20}, {25, 7, 18}, 1, 12, 3);
  for (size_t i = 0; i < lights.size(); i += 7) lights[i].probe = true;
  for (bool long_lists : {false, true}) {
    SCOPED_TRACE(long_lists);
    Exactness storage(yard(), width, height, fetched(false, long_lists));
    Exactness texels(yard(), width, height, fetched(true, long_lists));
    const Seen one = storage.expect_trials(camera, lights, every_algorithm(), 12);
    const Seen other = texels.expect_trials(camera, lights, every_algorithm(), 12);
    expect_same(one, other);
  }
}

// What devices with larger subgroups run: their own votes, and lights fetched where they are needed.
TEST_F(LightFetch, ProgramsForSubgroupsOfAnySizeGiveTheSameBits) {
  const Camera camera = camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
  std::vector<Light> lights = mixed_shapes(300, {-25, 0, -20}, {25, 7, 18}, 1, 12, 3);
  for (size_t i = 0; i < lights.size(); i += 7) lights[i].probe = true;
  FrameOptions any = fetched(false, false);
  any.tests.any_subgroup_size = true;
  Exactness known(yard(), width, height, fetched(false, false)), unknown(yard(), width, height, any);
  const Seen one = known.expect_trials(camera, lights, every_algorithm(), 12);
  const Seen other = unknown.expect_trials(camera, lights, every_algorithm(), 12);
  expect_same(one, other);
}

// Which programs test ahead: for long lists, and for subgroups of any size.
class TestingAhead : public DeviceTest, public testing::WithParamInterface<std::pair<bool, bool>> {};

TEST_P(TestingAhead, GivesTheSameBits) {
  if (on_swiftshader() && GetParam().second) GTEST_SKIP() << "takes minutes on SwiftShader";
  const Camera camera = camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
  std::vector<Light> lights = mixed_shapes(900, {-25, 0, -20}, {25, 7, 18}, 0.5, 9, 3);
  for (size_t i = 0; i < lights.size(); i += 7) lights[i].probe = true;
  FrameOptions options = fetched(true, GetParam().first);
  options.tests.any_subgroup_size = GetParam().second;
  Exactness batches(yard(), width, height, options);
  options.shading.test_ahead = true;
  Exactness ahead(yard(), width, height, options);
  const Seen one = batches.expect_trials(camera, lights, every_algorithm(), 12);
  const Seen other = ahead.expect_trials(camera, lights, every_algorithm(), 12);
  expect_same(one, other);
}

INSTANTIATE_TEST_SUITE_P(LightFetch, TestingAhead,
                         testing::Values(std::pair(false, false), std::pair(true, false),
                                         std::pair(true, true)),
                         [](const auto& instance) {
                           return std::string(instance.param.first ? "LongLists" : "ShortLists") +
                                  (instance.param.second ? "InSubgroupsOfAnySize" : "");
                         });

// A buffer of a single light is as small as buffers get.
TEST_F(LightFetch, OneLightAndNone) {
  const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, width, height);
  Exactness texels(yard(), width, height, fetched(true, false));
  texels.expect_trials(camera, {omni({0, 2, 2}, 9)}, every_algorithm(), 4);
  texels.expect_trials(camera, {}, every_algorithm(), 0);
}

}  // namespace
}  // namespace ml::test
