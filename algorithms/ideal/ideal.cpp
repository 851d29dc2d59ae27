#include "algorithms/ideal/ideal.h"

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
  void prepare(const FrameInput& frame, UploadMemory&, Spans&) override {
    counters_.in_frustum = frame.lights.count();
  }
  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {}; }
  ShadeShaders shade_shaders() const override {
    return {ideal_shade, ideal_shade_counting, ideal_forward, ideal_forward_counting};
  }

 private:
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry ideal_entry() {
  AlgorithmEntry entry;
  entry.info.name = "ideal";
  entry.info.summary = "per pixel exactly the lights that contribute, found beforehand: the lower bound";
  entry.info.needs_contributing_lists = true;
  entry.create = [](const Parameters&) { return std::make_unique<Ideal>(); };
  return entry;
}

}  // namespace ml
