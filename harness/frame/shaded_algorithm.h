// An algorithm with everything it needs on the device: its upload buffers and its two shading programs.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "algorithms/algorithm.h"
#include "harness/frame/device_frame.h"

namespace ml {

class ShadedAlgorithm final : private UploadMemory {
 public:
  // Throws SystemError when the device refuses a program or cannot hold a buffer.
  ShadedAlgorithm(gpu::Device& device, const AlgorithmEntry& entry, const Parameters& parameters,
                  const Effects& effects);

  // CPU: lists of the frame into mapped memory. Spans of the algorithm's stages.
  void prepare(const FrameInput& input, Spans& spans);

  // GPU, timed: list building and shading of the frame that is loaded.
  gpu::SubmissionTimes shade(DeviceFrame& frame, const FrameInput& input, gpu::Timing timing);
  // GPU, counting variant: fills the frame's counters too.
  void count(DeviceFrame& frame, const FrameInput& input);
  // The same for only the 8x8 blocks of the list, for sampled references: result and counters of other blocks
  // keep what they held. All is lit deferred and into one target, a reference for the
  // other ways. At most 65,535 blocks
  // (workgroups along one axis on the smallest devices).
  void count_blocks(DeviceFrame& frame, const FrameInput& input, std::span<const glm::uvec2> blocks);

  // A hash of every byte that the last prepare() gave to the GPU.
  uint64_t upload_digest() const;

  PrepareCounters counters() const { return algorithm_->counters(); }
  // Bytes of the buffers that the GPU reads, as allocated.
  uint64_t upload_bytes() const;
  const AlgorithmInfo& info() const { return entry_.info; }

 private:
  std::span<std::byte> map(uint32_t slot, size_t bytes) override;
  size_t limit() const override;
  gpu::Bindings bindings(const DeviceFrame& frame) const;
  // Records list building; what the shading pass binds.
  gpu::Bindings cull(gpu::Commands& commands, const DeviceFrame& frame, const FrameInput& input);
  void record(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input,
              const gpu::ComputeProgram& program, const gpu::RasterProgram* forward);

  gpu::Device& device_;
  const AlgorithmEntry& entry_;
  std::unique_ptr<Algorithm> algorithm_;
  std::vector<std::string> names_;
  std::deque<gpu::UploadBuffer> buffers_;
  gpu::UploadBuffer blocks_;
  std::vector<gpu::Constant> constants_;
  gpu::ComputeProgram timed_, counting_;
  std::optional<gpu::ComputeProgram> composite_;                        // with split targets
  std::optional<gpu::RasterProgram> forward_timed_, forward_counting_;  // with the effect
  std::unique_ptr<gpu::ComputeProgram> sampled_;                        // made when first asked for
};

}  // namespace ml
