// The worked example, through the public interface alone: what a new algorithm's author writes first.
#include "examples/frustum_list/frustum_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "algorithms/heap_memory.h"
#include "harness/bench/counting.h"
#include "harness/bench/workload.h"
#include "harness/config/config.h"
#include "harness/frame/shaded_algorithm.h"

namespace ml {
namespace {

// A small picture of the canyon. The frames look along the valley, into the tunnel and across it.
Config canyon() {
  return parse_config_text(
      R"({"name": "example", "scene": "canyon", "lights": {"placement": "volume", "count": 700, "animate": "drift"},
                               "camera": {"frames": 5}, "resolution": [121, 67], "algorithms": ["ideal"]})",
      "example", "");
}

Parameters with_sides(const AlgorithmEntry& entry, bool sides) {
  Parameters parameters(entry.parameters);
  parameters.set(entry.parameters, "sides", sides, "test");
  return parameters;
}

class FrustumList : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Sides, FrustumList, testing::Bool(),
                         [](const auto& sides) { return sides.param ? "culled" : "kept"; });

TEST_P(FrustumList, LosesNoLight) {
  const Config config = canyon();
  Workload workload(config.setups.front(), 1);
  gpu::Device device({.selector = "", .validation = true});
  FrameSequence& frames = workload.frames();
  DeviceFrame frame(device, *workload.scene(), workload.options(), frames.width(), frames.height());
  const AlgorithmEntry entry = frustum_list_entry();
  ShadedAlgorithm algorithm(device, entry, with_sides(entry, GetParam()), workload.options());
  Spans spans;
  double contributing = 0;
  for (uint32_t index = 0; index < frames.frames(); ++index) {
    const FrameInput& input = frames.at(index);
    frame.load(input);
    frame.find_contributing(input, LightLists::none);
    algorithm.prepare(input, spans, frame.occupied_blocks().positions());
    algorithm.count(frame, input);
    FrameCounters counters =
        summarize(read_counts(frame), frame.contributing(), lit_pixels(frame), algorithm.counters());
    EXPECT_EQ(counters.lost, 0u) << "frame " << index;
    EXPECT_EQ(counters.mismatched_pixels, 0u) << "frame " << index;
    EXPECT_DOUBLE_EQ(counters.listed, static_cast<double>(counters.prepare.in_frustum)) << "frame " << index;
    contributing += counters.contributing;
  }
  EXPECT_GT(contributing, 0);  // there was something to lose
  EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

std::vector<uint32_t> words(const HeapMemory& memory) {
  const std::span<const std::byte> bytes = memory.slot(0);
  std::vector<uint32_t> list(bytes.size() / sizeof(uint32_t));
  std::memcpy(list.data(), bytes.data(), list.size() * sizeof(uint32_t));
  return list;
}

TEST(FrustumListPrepare, SidesOnlyShortenTheList) {
  const Config config = canyon();
  Workload workload(config.setups.front(), 1);
  const AlgorithmEntry entry = frustum_list_entry();
  auto culled = entry.create(with_sides(entry, true)), kept = entry.create(with_sides(entry, false));
  Spans spans;
  for (uint32_t index = 0; index < workload.frames().frames(); ++index) {
    const FrameInput& input = workload.frames().at(index);
    HeapMemory few, many;
    culled->prepare(input, few, spans);
    kept->prepare(input, many, spans);
    // The length stands before the list.
    const std::vector<uint32_t> fewer = words(few), more = words(many);
    const std::vector<uint32_t> short_list(fewer.begin() + 1, fewer.end());
    const std::vector<uint32_t> long_list(more.begin() + 1, more.end());
    EXPECT_EQ(fewer[0], short_list.size());
    EXPECT_LT(short_list.size(), long_list.size());
    EXPECT_LE(long_list.size(), input.lights.count());
    EXPECT_TRUE(std::includes(long_list.begin(), long_list.end(), short_list.begin(), short_list.end()));
  }
}

}  // namespace
}  // namespace ml
