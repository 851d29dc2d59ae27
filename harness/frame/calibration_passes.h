// Passes of a known, constant amount of work for checking a device's clock.
#pragma once

#include <vector>

#include "harness/frame/level.h"
#include "harness/gpu/commands.h"

namespace ml {

class CalibrationPasses {
 public:
  explicit CalibrationPasses(gpu::Device& device);
  enum class Kind { compute, raster };
  // One submission of the passes in this order, a span each ("0", "1", ...).
  gpu::SubmissionTimes run(const std::vector<Kind>& order);

 private:
  gpu::Device& device_;
  gpu::Commands commands_;
  gpu::ComputeProgram compute_;
  gpu::Buffer sink_;
  Level level_;
  FrameTargets targets_;
  gpu::Buffer view_;
};

}  // namespace ml
