// Lists and memory from frame to frame, and at the device's limits.
#include "harness/accuracy/image_metrics.h"
#include "harness/base/error.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

TEST_F(HardCases, Case40_FramesAfterAFrameWithMoreLights) {
  constexpr uint32_t width = 80, height = 45;
  Exactness check(yard(), width, height);
  const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, width, height);
  std::vector<Light> many = scattered(3000, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 40),
                     few(many.begin(), many.begin() + 5);
  for (Light& light : few) light.shape = LightShape::omni;
  Seen before = check.expect_exact(camera, few);
  check.expect_exact(camera, many);
  // As if the large frame had never been; and none at all after it.
  Seen after = check.expect_exact(camera, few);
  EXPECT_EQ(compare_images(after.image, before.image).differing_bits, 0u);
  for (size_t i = 0; i < before.counts.size(); ++i)
    EXPECT_EQ(before.counts[i].listed, after.counts[i].listed);
  Seen none = check.expect_exact(camera, {});
  EXPECT_EQ(none.contributing(), 0u);
  for (const PixelCounts& counts : none.counts)
    for (uint32_t listed : counts.listed) ASSERT_EQ(listed, 0u);
  // The camera turns away from all lights, and back.
  check.expect_exact(camera_at({0, 3, 14}, {0, 1, 40}, width, height), many);
  check.expect_exact(camera, few);
}

TEST_F(HardCases, Case40_ResolutionChangesBetweenFrames) {
  // One algorithm, its buffers kept, over frames of different size, as a viewer that is resized.
  const Scene scene = yard();
  const FrameOptions options{.effects = {.spots = true}, .many_lights = false};
  std::vector<Light> lights = scattered(400, {-30, -1, -40}, {30, 12, 14}, 0.2f, 12, 41);
  const AlgorithmEntry& entry = find_algorithm("clustered", "test");
  ShadedAlgorithm algorithm(device(), entry, Parameters(entry.parameters), options);
  Threads threads;
  for (glm::uvec2 size : {glm::uvec2(64, 36), glm::uvec2(150, 90), glm::uvec2(33, 70), glm::uvec2(64, 36)}) {
    SCOPED_TRACE(testing::Message() << size.x << "x" << size.y);
    DeviceFrame frame(device(), scene, options, size.x, size.y);
    const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, size.x, size.y);
    FrameLightStorage storage;
    storage.fill(lights, camera.position);
    FrameInput input;
    input.view = view_data(camera, size.x, size.y, static_cast<uint32_t>(lights.size()));
    input.lights = storage.lights();
    input.threads = &threads;
    frame.load(input);
    const ContributingLights truth = frame.find_contributing(input, LightLists::none);
    Spans spans;
    algorithm.prepare(input, spans, frame.occupied_blocks().positions());
    algorithm.count(frame, input);
    FrameCounters counters = summarize(read_counts(frame), truth, lit_pixels(frame), algorithm.counters());
    EXPECT_EQ(counters.lost, 0u);
    EXPECT_EQ(counters.mismatched_pixels, 0u);
    EXPECT_GT(counters.contributing, 0.0);
  }
}

TEST_F(HardCases, Case43_ListsOverTheStorageRangeAreAnError) {
  // Every light is in every froxel of a fine grid: 4096 lights times 18 432 froxels of 4 bytes are 288 MiB,
  // times 32 bytes nine times as much.
  if (device().limits().storage_buffer_range > (uint64_t{1} << 28))
    GTEST_SKIP() << "the device's storage range is too large to fill";
  constexpr uint32_t width = 192, height = 96;
  std::vector<Light> lights(4096, omni({0, 3, 14}, 1e4f));
  const Camera camera = camera_at({0, 3, 14}, {0, 1, -10}, width, height);
  FrameLightStorage storage;
  storage.fill(lights, camera.position);
  Threads threads;
  FrameInput input;
  input.view = view_data(camera, width, height, static_cast<uint32_t>(lights.size()));
  input.lights = storage.lights();
  input.threads = &threads;
  const AlgorithmEntry& entry = find_algorithm("clustered", "test");
  for (const char* layout : {"indexed", "duplicated"}) {
    Parameters parameters(entry.parameters);
    parameters.set(entry.parameters, "tile", int64_t{4}, "test");
    parameters.set(entry.parameters, "light_data", std::string(layout), "test");
    ShadedAlgorithm algorithm(device(), entry, parameters, FrameOptions{.effects = {.spots = true}});
    Spans spans;
    try {
      algorithm.prepare(input, spans, {});
      ADD_FAILURE() << layout << ": no error";
    } catch (const SystemError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("clustered"), text.npos) << text;
      EXPECT_EQ(text.find('\n'), text.npos) << text;
    }
    // The next frame is an ordinary one.
    FrameInput one = input;
    one.lights.x = input.lights.x.first(1), one.lights.y = input.lights.y.first(1),
    one.lights.z = input.lights.z.first(1);
    one.lights.radius = input.lights.radius.first(1), one.lights.core = input.lights.core.first(1);
    one.view.light_count = 1;
    algorithm.prepare(one, spans, {});
    EXPECT_EQ(algorithm.counters().in_frustum, 1u);
  }
}

// Memory past the last light is garbage (gpu::DeviceOptions::poison); a test of one of those would be
// counted.
TEST_F(HardCases, Case56_NoLightPastTheCountIsLookedAt) {
  const Camera camera = camera_at({0, 6, 12}, {0, 0, 0}, 24, 16);
  Exactness check(floor_at({0, 0, 0}, 100), 24, 16, {.effects = {.spots = true}, .many_lights = false});
  for (uint32_t count : {1u, 2u, 3u, 5u, 7u, 8u, 9u, 15u, 17u, 31u, 33u, 63u, 64u, 65u, 129u}) {
    SCOPED_TRACE(count);
    // All of them everywhere: lists and batches are full, the last batch is not.
    const std::vector<Light> lights = scattered(count, {-2, 1, -2}, {2, 3, 2}, 60, 80, count, 0);
    const Seen seen = check.expect_trials(camera, lights, every_algorithm(), 0);
    for (const PixelCounts& counts : seen.counts)
      for (size_t i = 0; i < counts.tested.size(); ++i) ASSERT_LE(counts.tested[i], count) << "pixel " << i;
  }
}

}  // namespace
}  // namespace ml::test
