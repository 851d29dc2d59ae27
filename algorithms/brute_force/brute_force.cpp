#include "algorithms/brute_force/brute_force.h"

#include "spirv/brute_force_forward.h"
#include "spirv/brute_force_forward_counting.h"
#include "spirv/brute_force_forward_fp64.h"
#include "spirv/brute_force_forward_fp64_counting.h"
#include "spirv/brute_force_shade.h"
#include "spirv/brute_force_shade_counting.h"
#include "spirv/brute_force_shade_fp64.h"
#include "spirv/brute_force_shade_fp64_counting.h"

namespace ml {
namespace {

class BruteForce final : public Algorithm {
 public:
  explicit BruteForce(const Parameters& parameters) : fp64_(parameters.choice("precision") == "fp64") {}

  void prepare(const FrameInput& frame, UploadMemory&, Spans&) override {
    counters_.in_frustum = frame.lights.count();
  }
  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {}; }
  bool walks_ranges() const override { return true; }
  ShadeShaders shade_shaders() const override {
    if (fp64_)
      return {brute_force_shade_fp64, brute_force_shade_fp64_counting, brute_force_forward_fp64,
              brute_force_forward_fp64_counting};
    return {brute_force_shade, brute_force_shade_counting, brute_force_forward, brute_force_forward_counting};
  }

 private:
  bool fp64_;
  PrepareCounters counters_;
};

double test_seconds(const Parameters&, uint32_t width, uint32_t height, uint32_t lights) {
  constexpr double test = 4.6e-9;  // 609 ms for 1024 lights at 480x270
  return width * test * height * lights;
}

}  // namespace

AlgorithmEntry brute_force_entry() {
  AlgorithmEntry entry;
  entry.info.name = "brute_force";
  entry.info.summary = "every light for every pixel: the reference";
  entry.info.reference_only = true;
  entry.parameters = {
      ParameterInfo::choice("precision", "fp32", {"fp32", "fp64"},
                            "number type of the shading sums; fp64 needs a device with 64-bit floats")};
  entry.create = [](const Parameters& parameters) { return std::make_unique<BruteForce>(parameters); };
  entry.further_seconds = test_seconds;
  return entry;
}

}  // namespace ml
