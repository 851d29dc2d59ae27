// Submissions that are forked onto the second queue, or through the same semaphores onto the one there is.
#include <gtest/gtest.h>

#include <cstring>

#include "harness/gpu/commands.h"
#include "shaders/shared/slices.h"
#include "spirv/slices_comp.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Fork : public DeviceTest {
 protected:
  struct Push {
    gpu_data::SliceMapping mapping{0, 1, 4};
    uint32_t count = 64;
  };
  static constexpr size_t bytes = 256;
  gpu::Buffer buffer(const char* name) { return {device(), bytes, gpu::MemoryKind::device, name}; }
  std::vector<uint32_t> words(const gpu::Buffer& back) {
    std::vector<uint32_t> list(bytes / 4);
    std::memcpy(list.data(), back.mapped().data(), bytes);
    return list;
  }

  gpu::ComputeProgram program_{device(), slices_comp, "slices"};
  gpu::Buffer in_ = buffer("in"), out_ = buffer("out"), other_ = buffer("other");
  gpu::Buffer back_{device(), bytes, gpu::MemoryKind::readback, "back"},
      other_back_{device(), bytes, gpu::MemoryKind::readback, "other back"};
  gpu::Commands commands_{device()};
};

TEST_F(Fork, BothSidesComeAfterWhatWasBeforeAndBeforeWhatIsAfter) {
  for (uint32_t round = 0; round < 20; ++round) {
    // Depth 1.0 is slice 1, 0.0 slice 0: what the program finds says what the fill before it left.
    const bool near = round % 2;
    commands_.begin(round % 3 ? gpu::Timing::stages : gpu::Timing::none);
    {
      auto span = commands_.span("before");
      commands_.fill(in_, near ? 0x3f800000 : 0);
      commands_.fill(out_, 77);
    }
    commands_.fork(
        [&] {
          auto span = commands_.span("second");
          commands_.dispatch(program_, {{"Depths", in_}, {"Slices", out_}}, Push(), 1);
        },
        [&] {
          auto span = commands_.span("beside");
          commands_.fill(other_, round);
        });
    {
      auto span = commands_.span("after");
      commands_.read_buffer(out_, bytes, back_);
      commands_.read_buffer(other_, bytes, other_back_);
    }
    const gpu::SubmissionTimes times = commands_.submit();
    EXPECT_TRUE(times.forked);
    EXPECT_EQ(words(back_), std::vector<uint32_t>(bytes / 4, near)) << "round " << round;
    EXPECT_EQ(words(other_back_), std::vector<uint32_t>(bytes / 4, round));
    const bool timed = round % 3 && device().limits().timestamp_valid_bits;
    EXPECT_EQ(times.spans.empty(), !timed);
    EXPECT_EQ(times.disorder, 0.0);
    if (device().info().second_queue == gpu::SecondQueue::none) {
      EXPECT_EQ(times.both_queues, 0.0);
    }
    // A submission in between that is not forked.
    commands_.begin(gpu::Timing::none);
    commands_.fill(out_, 5);
    EXPECT_FALSE(commands_.submit().forked);
  }
}

TEST_F(Fork, SpansStandInTheOrderOfTheirParts) {
  if (device().limits().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  if (device().limits().second_timestamp_valid_bits == 0) GTEST_SKIP() << "the second queue has none";
  commands_.begin(gpu::Timing::stages);
  auto pass = [&](const char* name, const gpu::Buffer& into) {
    auto span = commands_.span(name);
    commands_.fill(into, 1);
  };
  pass("first", in_);
  commands_.fork([&] { pass("second", out_); }, [&] { pass("beside", other_); });
  pass("last", in_);
  const gpu::SubmissionTimes times = commands_.submit();
  ASSERT_EQ(times.intervals.size(), 4u);
  const auto &first = times.intervals[0], &second = times.intervals[1], &beside = times.intervals[2],
             &last = times.intervals[3];
  EXPECT_TRUE(second.second_queue);
  EXPECT_GE(second.begin, first.end);
  EXPECT_GE(beside.begin, first.end);
  EXPECT_GE(last.begin, second.end);
  EXPECT_GE(last.begin, beside.end);
  EXPECT_GE(times.whole * (1 + 1e-9), last.end);
}

TEST_F(Fork, WhatMayNotBeIsSaid) {
  EXPECT_THROW(commands_.fork([] {}, [] {}), std::logic_error) << "nothing is recorded";
  gpu::Image image(device(), 8, 8, gpu::Format::r32_uint, gpu::ImageUse::storage, "image");
  gpu::Image depth(device(), 8, 8, gpu::Format::d32_float, gpu::ImageUse::attachment, "depth");
  commands_.begin(gpu::Timing::none);
  commands_.clear(image);
  commands_.fork(
      [&] {
        commands_.clear(image);
        EXPECT_THROW(commands_.raster({{}, &depth}, in_, in_, {}), std::logic_error);
      },
      [&] { EXPECT_THROW(commands_.clear(image), std::logic_error) << "the second queue has it"; });
  commands_.clear(image);
  EXPECT_THROW(commands_.fork([] {}, [] {}), std::logic_error) << "a second fork";
  commands_.submit();
  // All is as it was for the next one.
  commands_.begin(gpu::Timing::none);
  commands_.fork([&] { commands_.clear(image); }, [] {});
  commands_.submit();
}

TEST_F(Fork, UnorderedPassesAreAllDoneAfterTheScope) {
  commands_.begin(gpu::Timing::none);
  commands_.fill(in_, 0x3f800000);
  commands_.fill(out_, 0);
  {
    auto apart = commands_.unordered();
    commands_.dispatch(program_, {{"Depths", in_}, {"Slices", out_}}, Push(), 1);
    commands_.dispatch(program_, {{"Depths", in_}, {"Slices", other_}}, Push(), 1);
  }
  commands_.read_buffer(out_, bytes, back_);
  commands_.read_buffer(other_, bytes, other_back_);
  commands_.submit();
  EXPECT_EQ(words(back_), std::vector<uint32_t>(bytes / 4, 1));
  EXPECT_EQ(words(other_back_), std::vector<uint32_t>(bytes / 4, 1));
}

TEST_F(Fork, TwoWritesOfUnorderedPassesAreNoHazard) {
  // The layer knows whole buffers, and would call these one.
  const size_t before = device().validation_messages().size();
  commands_.begin(gpu::Timing::none);
  {
    auto apart = commands_.unordered();
    commands_.fill(out_, 1);
    commands_.fill(out_, 1);
  }
  commands_.submit();
  EXPECT_EQ(device().validation_messages().size(), before);
}

}  // namespace
}  // namespace ml::test
