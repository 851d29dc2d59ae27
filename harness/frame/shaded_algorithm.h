// An algorithm with everything it needs on the device: its upload buffers, its device half with the images of
// its own, and the shading loop, the part that the harness has for all.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "algorithms/algorithm.h"
#include "harness/frame/device_frame.h"
#include "harness/frame/own_images.h"
#include "harness/frame/shading_loops.h"

namespace ml {

class ShadedAlgorithm final : private UploadMemory {
 public:
  // Throws SystemError when the device refuses a program or cannot hold a buffer.
  ShadedAlgorithm(gpu::Device& device, const AlgorithmEntry& entry, const Parameters& parameters,
                  const FrameOptions& options);

  // CPU: lists of the frame into mapped memory. Spans of the algorithm's stages. `blocks`: the 8x8 px blocks
  // that will be shaded, in their order: those of the frame that is loaded (OccupiedBlocks).
  void prepare(const FrameInput& input, Spans& spans, std::span<const glm::u16vec2> blocks);

  // GPU, timed: list building and shading of the frame that is loaded.
  gpu::SubmissionTimes shade(DeviceFrame& frame, const FrameInput& input, gpu::Timing timing);
  // GPU, counting variant: fills the frame's counters too.
  void count(DeviceFrame& frame, const FrameInput& input);
  // The same for only the 8x8 blocks of the list, for sampled references: result and counters of other blocks
  // keep what they held. All is lit deferred and into one target, a reference for the other ways. At most
  // 65,535 blocks (workgroups along one axis on the smallest devices).
  void count_blocks(DeviceFrame& frame, const FrameInput& input, std::span<const glm::u16vec2> blocks);

  // A hash of every byte that the last prepare() gave to the GPU.
  uint64_t upload_digest() const;

  const PrepareCounters& counters() const { return counters_; }
  // After count(): the counters that it declares (AlgorithmInfo::counters), those of frames and of pixels.
  const CounterValues& own_counters() const { return own_counters_; }
  std::map<std::string, std::vector<uint32_t>> own_pixel_counters(DeviceFrame& frame) const {
    return own_images_.read_counters(frame);
  }
  // An image that its device half declares, of the last frame; null: there is none of that name yet.
  const gpu::Image* own_image(const std::string& name) const { return own_images_.find(name); }
  // After count() (Algorithm::lights_listed, DeviceAlgorithm::lights_listed).
  std::optional<uint32_t> lights_listed(glm::uvec2 pixel, float depth) const {
    const std::optional<uint32_t> known = algorithm_->lights_listed(pixel, depth);
    return known ? known : device_half_->lights_listed(pixel);
  }
  // Bytes of the buffers that the GPU reads, as allocated.
  uint64_t upload_bytes() const;
  const AlgorithmInfo& info() const { return entry_.info; }
  // The lists of contributing lights that its shading binds.
  LightLists wanted_lists() const {
    if (!entry_.info.needs_contributing_lists) return LightLists::none;
    return together_ ? LightLists::groups : LightLists::pixels;
  }

 private:
  std::span<std::byte> map(uint32_t slot, size_t bytes) override;
  size_t limit() const override;
  bool cached(uint32_t slot) const override;
  class Resources;
  // The input as this algorithm sees it: with its own step.
  FrameInput stepped(const FrameInput& input) const;
  void record(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input, bool counting);
  void record_loop(gpu::Commands& commands, DeviceFrame& frame, const FrameInput& input, bool counting,
                   const gpu::Bindings& list);

  // What a program of the shading loop is compiled for.
  struct Variant {
    bool counting = false;
    bool sampled = false;  // the deferred reference of count_blocks()
    ShadingLoop loop;
    uint32_t tile_class = 0;
    auto operator<=>(const Variant&) const = default;
  };
  // Made when first asked for: throws SystemError when the device refuses it.
  const gpu::ComputeProgram& program(const Variant& variant);
  const gpu::RasterProgram& forward_program(bool counting, bool long_walks);
  // Lights that a dispatch looks at; more take several.
  uint32_t range() const;
  ShadingLoop loop_of(const DeviceFrame& frame, const FrameInput& input, bool together) const;
  // Records the blocks [begin, end) of the list that is bound.
  void shade_blocks(gpu::Commands& commands, const Variant& variant, const gpu::Bindings& bindings,
                    const FrameInput& input, uint32_t begin, uint32_t end);
  // Sorts the blocks by the class of the tiles that they lie in.
  void sort_blocks(const FrameInput& input, std::span<const glm::u16vec2> blocks);
  struct TileRange {
    uint32_t first, last;
  };
  static void tiles_across(std::vector<TileRange>& tiles, uint32_t pixels, uint32_t tile, uint32_t count);

  gpu::Device& device_;
  const AlgorithmEntry& entry_;
  std::unique_ptr<Algorithm> algorithm_;
  std::unique_ptr<DeviceAlgorithm> device_half_;
  OwnImages own_images_;
  PrepareCounters counters_;
  CounterValues own_counters_;
  Step step_ = Step::first;             // of the frame that was prepared last
  std::optional<uint32_t> last_index_;  // its number
  std::vector<std::string> names_;
  std::vector<bool> mapped_;  // which of them prepare() has mapped
  std::deque<gpu::UploadBuffer> buffers_;
  FrameOptions options_;
  bool together_;
  gpu::UploadBuffer sampled_blocks_;
  // The blocks of each class one after the other; class c's are [block_ends_[c - 1], block_ends_[c]). Not in
  // use while all blocks are of one class.
  gpu::UploadBuffer class_blocks_;
  std::vector<uint8_t> class_of_block_;
  std::vector<TileRange> tiles_of_column_, tiles_of_row_;  // of blocks
  std::vector<uint32_t> block_ends_;
  uint32_t only_class_ = 0;
  bool one_class_ = true;
  std::map<Variant, gpu::ComputeProgram> programs_;
  std::optional<gpu::ComputeProgram> composite_;                          // with split targets
  std::map<std::pair<bool, bool>, gpu::RasterProgram> forward_programs_;  // by (counting, long walks)
};

}  // namespace ml
