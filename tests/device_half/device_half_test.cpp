// The device half of an algorithm: passes of its own, images, a history by steps, counters.
#include <gtest/gtest.h>

#include <stdexcept>

#include "accumulating.h"
#include "harness/bench/counting.h"
#include "harness/frame/shaded_algorithm.h"
#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 40, height = 22;
constexpr uint32_t lights = 30;

class DeviceHalf : public DeviceTest {
 protected:
  DeviceHalf()
      : frame_(device(), yard(), options_, width, height),
        entry_(accumulating_entry()),
        algorithm_(device(), entry_, {}, options_) {
    storage_.fill(scattered(lights, {-20, 0, -20}, {20, 6, 14}, 3, 15, 4, 0), {0, 0, 0});
    input_.threads = &threads_;
    input_.lights = storage_.lights();
    input_.view = view_data(camera_at({0, 3, 14}, {0, 1, -10}, width, height), width, height, lights);
  }
  // Prepares, counts and shades the frame; all of that is one frame to a history.
  void frame(uint32_t index, Step step) {
    input_.index = index;
    input_.step = step;
    frame_.load(input_);
    Spans spans;
    algorithm_.prepare(input_, spans, frame_.occupied_blocks().positions());
    algorithm_.count(frame_, input_);
    algorithm_.shade(frame_, input_, gpu::Timing::none);
  }
  // How many pictures the history holds, the same for every pixel that sees something; else -1.
  float accumulated() {
    const std::vector<uint8_t> lit = lit_pixels(frame_);
    const std::vector<float> sum = frame_.read_floats(*algorithm_.own_image("Sum"));
    float count = 0;
    for (size_t i = 0; i < lit.size(); ++i) {
      if (!lit[i]) continue;
      if (count == 0) count = sum[4 * i + 3];
      if (sum[4 * i + 3] != count) return -1;
    }
    return count;
  }

  FrameOptions options_{.many_lights = false};
  Threads threads_{1};
  FrameLightStorage storage_;
  FrameInput input_;
  DeviceFrame frame_;
  AlgorithmEntry entry_;
  ShadedAlgorithm algorithm_;
};

TEST_F(DeviceHalf, HistoryGoesOnWithTheNextFrameStaysWithTheSameAndBeginsAnewWithTheFirst) {
  frame(0, Step::first);
  EXPECT_EQ(accumulated(), 1);
  frame(1, Step::next);
  EXPECT_EQ(accumulated(), 2);
  frame(1, Step::next);  // the algorithm has seen it: the same once more
  EXPECT_EQ(accumulated(), 2);
  frame(2, Step::next);
  EXPECT_EQ(accumulated(), 3);
  frame(3, Step::first);  // a cut
  EXPECT_EQ(accumulated(), 1);
  frame(4, Step::next);
  EXPECT_EQ(accumulated(), 2);
  frame(0, Step::first);  // another lap
  EXPECT_EQ(accumulated(), 1);
  frame(7, Step::next);  // it follows on no frame that the algorithm saw
  EXPECT_EQ(accumulated(), 1);
}

TEST_F(DeviceHalf, SumIsThatOfThePictures) {
  frame(0, Step::first);
  const std::vector<float> one = frame_.read_floats(frame_.targets().result);
  frame(1, Step::next);
  frame(2, Step::next);
  const std::vector<float> sum = frame_.read_floats(*algorithm_.own_image("Sum"));
  for (size_t i = 0; i < one.size(); ++i) {
    if (i % 4 == 3) continue;
    ASSERT_NEAR(sum[i], 3 * one[i], 1e-5f * (1 + 3 * one[i])) << "word " << i;
  }
}

TEST_F(DeviceHalf, ItsPassesHaveSpansAndTheLoopKeepsItsOwn) {
  frame(0, Step::first);
  const gpu::SubmissionTimes times = algorithm_.shade(frame_, input_, gpu::Timing::stages);
  std::vector<std::string> names;
  for (const auto& [name, ms] : times.spans) names.push_back(name);
  for (const char* name : {"mark", "shade", "accumulate"})
    EXPECT_TRUE(std::ranges::find(names, name) != names.end()) << name;
  EXPECT_EQ(names.size(), 3u);
}

TEST_F(DeviceHalf, CountersOfBothKindsAreThoseThatItDeclares) {
  frame(0, Step::first);
  const std::vector<uint8_t> lit = lit_pixels(frame_);
  const auto values =
      own_counters(algorithm_.info(), algorithm_.own_counters(), algorithm_.own_pixel_counters(frame_), lit);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(values.at("asked"), lights + 1);  // and once in vain
  EXPECT_EQ(values.at("seen_pixels"), std::ranges::count(lit, 1));
  EXPECT_GT(values.at("seen_pixels"), 100);
  AlgorithmInfo more = algorithm_.info();
  more.counters.push_back({"forgotten", "nobody gives it"});
  EXPECT_THROW(own_counters(more, algorithm_.own_counters(), algorithm_.own_pixel_counters(frame_), lit),
               std::logic_error);
}

TEST_F(DeviceHalf, CountersOfPixelsLitForwardAreThereToo) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  Scene scene = yard();
  for (Material& material : scene.materials) material.forward = true;
  FrameOptions options = options_;
  options.effects.forward = true;
  DeviceFrame frame(device(), scene, options, width, height);
  ShadedAlgorithm algorithm(device(), entry_, {}, options);
  frame.load(input_);
  Spans spans;
  algorithm.prepare(input_, spans, frame.occupied_blocks().positions());
  algorithm.count(frame, input_);
  const auto values = own_counters(algorithm.info(), algorithm.own_counters(),
                                   algorithm.own_pixel_counters(frame), lit_pixels(frame));
  EXPECT_EQ(values.at("asked"), lights + 1);
}

// Forgets one of its buffers.
class Forgetful final : public Algorithm {
 public:
  void prepare(const FrameInput&, UploadMemory& memory, Spans&) override { memory.map(0, 16); }
  PrepareCounters counters() const override { return {}; }
  std::vector<std::string> buffers() const override { return {"Mapped", "Forgotten"}; }
  ShadeShaders shade_shaders() const override { return {}; }
};

TEST_F(DeviceHalf, EveryBufferIsMapped) {
  AlgorithmEntry entry = entry_;
  entry.create = [](const Parameters&) { return std::make_unique<Forgetful>(); };
  ShadedAlgorithm algorithm(device(), entry, {}, options_);
  frame_.load(input_);
  Spans spans;
  try {
    algorithm.prepare(input_, spans, frame_.occupied_blocks().positions());
    FAIL() << "nothing is said";
  } catch (const std::logic_error& refused) {
    EXPECT_NE(std::string(refused.what()).find("Forgotten"), std::string::npos) << refused.what();
  }
}

TEST_F(DeviceHalf, CountersHaveNamesOfTheirOwn) {
  frame(0, Step::first);
  AlgorithmInfo taken = algorithm_.info();
  taken.counters.front().name = "listed";
  EXPECT_THROW(own_counters(taken, algorithm_.own_counters(), algorithm_.own_pixel_counters(frame_),
                            lit_pixels(frame_)),
               std::logic_error);
}

TEST_F(DeviceHalf, AnotherResolutionBeginsAnew) {
  frame(0, Step::first);
  frame(1, Step::next);
  DeviceFrame other(device(), yard(), options_, 17, 9);
  FrameInput input = input_;
  input.index = 2;
  input.step = Step::next;
  input.view = view_data(camera_at({0, 3, 14}, {0, 1, -10}, 17, 9), 17, 9, lights);
  other.load(input);
  Spans spans;
  algorithm_.prepare(input, spans, other.occupied_blocks().positions());
  algorithm_.count(other, input);
  const std::vector<float> sum = other.read_floats(*algorithm_.own_image("Sum"));
  ASSERT_EQ(sum.size(), 17u * 9 * 4);
  for (size_t i = 3; i < sum.size(); i += 4) EXPECT_LE(sum[i], 1);
}

}  // namespace
}  // namespace ml::test
