#include "algorithms/ideal/ideal.h"

#include "algorithms/device_algorithm.h"
#include "harness/gpu/device.h"
#include "shaders/shared/pixel_groups.h"
#include "spirv/ideal_forward.h"
#include "spirv/ideal_forward_counting.h"
#include "spirv/ideal_shade.h"
#include "spirv/ideal_shade_counting.h"

namespace ml {
namespace {

// The lists come from the harness (harness/frame/device_frame.h), which needs them for the proof that no
// light was lost.
class Ideal final : public Algorithm {
 public:
  explicit Ideal(const Parameters& p) : together_(p.choice("walk") == "subgroup") {}

  void prepare(const FrameInput& frame, UploadMemory&, Spans&) override {
    counters_.in_frustum = frame.lights.count();
  }
  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {}; }
  bool walks_together() const override { return together_; }
  ShadeShaders shade_shaders() const override {
    return {ideal_shade, ideal_shade_counting, ideal_forward, ideal_forward_counting};
  }
  std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context) override {
    group_pixels_ = gpu_data::group_pixels(context.device.limits().subgroup_size);
    return Algorithm::device_half(context);
  }
  gpu::Constants shade_constants() const override { return {{"GROUP_PIXELS", group_pixels_}}; }

 private:
  bool together_;
  uint32_t group_pixels_ = 1;
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry ideal_entry() {
  AlgorithmEntry entry;
  entry.info.name = "ideal";
  entry.info.summary = "per pixel exactly the lights that contribute, found beforehand: the lower bound";
  entry.info.needs_contributing_lists = true;
  entry.parameters = {ParameterInfo::choice(
      "walk", "pixel", {"pixel", "subgroup"},
      "each pixel walks its own list, or the pixels of a subgroup walk together what contributes to any of "
      "them, fetching each light once")};
  entry.create = [](const Parameters& parameters) { return std::make_unique<Ideal>(parameters); };
  return entry;
}

}  // namespace ml
