#include "accumulating.h"

#include "algorithms/device_algorithm.h"
#include "spirv/accumulating_accumulate.h"
#include "spirv/accumulating_forward.h"
#include "spirv/accumulating_forward_counting.h"
#include "spirv/accumulating_mark.h"
#include "spirv/accumulating_shade.h"
#include "spirv/accumulating_shade_counting.h"

namespace ml::test {
namespace {

constexpr uint32_t mark = 7;

class Passes final : public DeviceAlgorithm {
 public:
  explicit Passes(const DeviceContext& context)
      : mark_(context.device, accumulating_mark, "accumulating: mark", {{"MARK", mark}}),
        accumulate_(context.device, accumulating_accumulate, "accumulating: accumulate"),
        seen_(context.device, sizeof(uint32_t), gpu::MemoryKind::device, "accumulating: seen"),
        readback_(context.device, sizeof(uint32_t), gpu::MemoryKind::readback, "accumulating: readback") {}

  std::vector<OwnImage> images() const override {
    return {{"Marks", "7 where something is seen", gpu::Format::r32_uint},
            {"Sum", "the pictures since the last cut, and how many", gpu::Format::rgba32_float, true}};
  }
  void build(gpu::Commands& commands, const FrameInput& frame, FrameResources& resources) override {
    auto span = commands.span("mark");
    commands.fill(seen_, 0);
    resources.publish("Seen", seen_);
    over_all(commands, mark_, frame, resources);
  }
  void shade(gpu::Commands& commands, const FrameInput& frame, FrameResources& resources,
             ShadeVariant) override {
    resources.shading_loop();
    auto span = commands.span("accumulate");
    over_all(commands, accumulate_, frame, resources);
  }
  void read_counters(gpu::Commands& commands, PrepareCounters&, CounterValues& values) override {
    commands.begin(gpu::Timing::none);
    commands.read_buffer(seen_, sizeof(uint32_t), readback_);
    commands.submit();
    values["seen_pixels"] = *reinterpret_cast<const uint32_t*>(readback_.mapped().data());
  }
  uint64_t bytes() const override { return seen_.bytes(); }

 private:
  static void over_all(gpu::Commands& commands, const gpu::ComputeProgram& program, const FrameInput& frame,
                       FrameResources& resources) {
    commands.dispatch(program, resources.bindings(), std::span<const std::byte>{},
                      (frame.view.resolution.x + 7) / 8, (frame.view.resolution.y + 7) / 8);
  }
  gpu::ComputeProgram mark_, accumulate_;
  gpu::Buffer seen_, readback_;
};

class Accumulating final : public Algorithm {
 public:
  void prepare(const FrameInput& frame, UploadMemory&, Spans&) override {
    counters_.in_frustum = frame.lights.count();
  }
  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {}; }
  ShadeShaders shade_shaders() const override {
    return {accumulating_shade, accumulating_shade_counting, accumulating_forward,
            accumulating_forward_counting};
  }
  std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context) override {
    return std::make_unique<Passes>(context);
  }

 private:
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry accumulating_entry() {
  AlgorithmEntry entry;
  entry.info.name = "accumulating";
  entry.info.summary = "every light for every pixel, summed up over frames";
  entry.info.passes = {{"mark", PassKind::lists}, {"accumulate", PassKind::post}};
  entry.info.counters = {{"asked", "calls of the cursor for a pixel, mean over lit pixels", true},
                         {"seen_pixels", "pixels that see something, per frame"}};
  entry.create = [](const Parameters&) { return std::make_unique<Accumulating>(); };
  return entry;
}

}  // namespace ml::test
