// Dispatches and their times.
#include "harness/gpu/commands.h"

#include <gtest/gtest.h>

#include <cstring>

#include "harness/base/error.h"
#include "harness/frame/calibration_passes.h"
#include "shaders/shared/slices.h"
#include "spirv/slices_comp.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Dispatch : public DeviceTest {
 protected:
  struct Push {
    gpu_data::SliceMapping mapping{0, 1, 4};
    uint32_t count = 64;
  };
  gpu::ComputeProgram program_{device(), slices_comp, "slices"};
  gpu::Buffer in_{device(), 256, gpu::MemoryKind::device, "in"},
      out_{device(), 256, gpu::MemoryKind::device, "out"};
  gpu::Commands commands_{device()};
};

TEST_F(Dispatch, MissingAndWrongBindingsAreNamed) {
  gpu::Image image(device(), 4, 4, gpu::Format::r32_uint, gpu::ImageUse::storage, "image");
  auto error_of = [&](const gpu::Bindings& bindings, std::span<const std::byte> push) -> std::string {
    try {
      commands_.dispatch(program_, bindings, push, 1);
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "";
  };
  const Push push;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(&push, 1));
  commands_.begin(gpu::Timing::none);
  EXPECT_EQ(error_of({{"Depths", in_}}, bytes), "slices: nothing is bound to 'Slices'");
  EXPECT_EQ(error_of({{"Depths", in_}, {"Slices", image}}, bytes), "slices: 'Slices' is a buffer");
  EXPECT_NE(error_of({{"Depths", in_}, {"Slices", out_}}, bytes.first(8)).find("push constants"),
            std::string::npos);
  // What the program does not use may be bound too.
  EXPECT_EQ(error_of({{"Depths", in_}, {"Unused", image}, {"Slices", out_}}, bytes), "");
  EXPECT_THROW(commands_.dispatch(program_, {{"Depths", in_}, {"Slices", out_}}, push,
                                  device().limits().group_count[0] + 1),
               SystemError);
  commands_.dispatch(program_, {}, push, 0);  // no workgroups: nothing to do
  commands_.submit();
}

TEST_F(Dispatch, ManyDispatchesInOneSubmission) {
  // More than one pool of descriptor sets holds, each ordered after the one before.
  gpu::Buffer back(device(), 256, gpu::MemoryKind::readback, "back");
  commands_.begin(gpu::Timing::none);
  commands_.fill(in_, 0x3f800000);  // 1.0
  commands_.fill(out_, 0);
  for (int i = 0; i < 600; ++i) commands_.dispatch(program_, {{"Depths", in_}, {"Slices", out_}}, Push(), 1);
  commands_.read_buffer(out_, 256, back);
  commands_.submit();
  std::vector<uint32_t> words(64);
  std::memcpy(words.data(), back.mapped().data(), 256);
  EXPECT_EQ(words, std::vector<uint32_t>(64, 1));
}

TEST_F(Dispatch, SpansComeInOrderAndSumByName) {
  if (device().limits().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  auto record = [&](gpu::Timing timing) {
    commands_.begin(timing);
    for (const char* name : {"second", "first", "second"}) {
      auto span = commands_.span(name);
      commands_.dispatch(program_, {{"Depths", in_}, {"Slices", out_}}, Push(), 1);
    }
    return commands_.submit();
  };
  gpu::SubmissionTimes stages = record(gpu::Timing::stages);
  ASSERT_EQ(stages.spans.size(), 2u);
  EXPECT_EQ(stages.spans[0].first, "second");
  EXPECT_EQ(stages.spans[1].first, "first");
  double sum = 0;
  for (const auto& [name, ms] : stages.spans) {
    EXPECT_GE(ms, 0.0);
    sum += ms;
  }
  EXPECT_GE(stages.whole * (1 + 1e-9), sum);
  EXPECT_GT(stages.fence, 0.0);

  gpu::SubmissionTimes whole = record(gpu::Timing::whole);
  EXPECT_TRUE(whole.spans.empty());
  EXPECT_GT(whole.whole, 0.0);
  gpu::SubmissionTimes none = record(gpu::Timing::none);
  EXPECT_TRUE(none.spans.empty());
  EXPECT_EQ(none.whole, 0.0);
}

TEST_F(Dispatch, CallsOutOfTurnAndCopiesThatDoNotFitAreErrors) {
  gpu::Buffer small(device(), 128, gpu::MemoryKind::readback, "small");
  gpu::Image image(device(), 8, 8, gpu::Format::r32_uint, gpu::ImageUse::storage, "image");
  EXPECT_THROW(commands_.submit(), std::logic_error);
  commands_.begin(gpu::Timing::none);
  EXPECT_THROW(commands_.begin(gpu::Timing::none), std::logic_error);
  EXPECT_THROW(commands_.read_buffer(in_, 256, small), std::logic_error);
  EXPECT_THROW(commands_.read_buffer(in_, 257, out_), std::logic_error);
  EXPECT_THROW(commands_.read_image(image, small), std::logic_error);
  EXPECT_THROW(commands_.write_image(small, image), std::logic_error);
  {
    auto apart = commands_.unordered();
    EXPECT_THROW(static_cast<void>(commands_.unordered()), std::logic_error);
  }
  commands_.submit();
}

TEST_F(Dispatch, MoreSpansThanStampsAreAnError) {
  if (device().limits().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  commands_.begin(gpu::Timing::stages);
  size_t spans = 0;
  EXPECT_THROW(for (; spans < 1000; ++spans) static_cast<void>(commands_.span("pass")), std::logic_error);
  EXPECT_EQ(spans, 127u);
  EXPECT_EQ(commands_.submit().intervals.size(), spans);
}

TEST_F(Dispatch, WholeHoldsTheSpansOfRasterAndComputePasses) {
  if (device().limits().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  CalibrationPasses passes(device());
  using Kind = CalibrationPasses::Kind;
  for (const std::vector<Kind>& order :
       {std::vector{Kind::compute, Kind::raster}, std::vector{Kind::raster, Kind::compute, Kind::raster}}) {
    gpu::SubmissionTimes times = passes.run(order);
    ASSERT_EQ(times.spans.size(), order.size());
    double sum = 0;
    for (size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(times.spans[i].first, std::to_string(i));
      EXPECT_GT(times.spans[i].second, 0.0);
      sum += times.spans[i].second;
    }
    EXPECT_GE(times.whole * (1 + 1e-9), sum);
  }
}

}  // namespace
}  // namespace ml::test
