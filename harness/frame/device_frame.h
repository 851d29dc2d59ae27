// One setup on the device: level, targets, the frame's view and lights, and everything that all algorithms
// share.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/algorithm.h"
#include "harness/frame/frame_options.h"
#include "harness/frame/level.h"
#include "harness/frame/occupied_blocks.h"
#include "harness/frame/shadow_maps.h"
#include "harness/frame/targets.h"
#include "harness/gpu/commands.h"

namespace ml {

// Per-pixel counts of contributing lights, found without any algorithm under test, and on demand the lists
// themselves.
struct ContributingLights {
  std::vector<uint32_t> count;  // per pixel
  std::vector<uint32_t> hash;   // per pixel: sum of light_hash over the set
  // Per pixel: lights that contribute to some pixel of its group; empty where lists of groups were not asked
  // for.
  std::vector<uint32_t> group = {};
};

// What shading passes need of it, kept for when the same frame comes again: to find it takes many times as long
// as to upload it.
struct SavedContributing {
  std::vector<uint32_t> count, offsets, indices, group_offsets, group_indices;
  size_t bytes() const {
    return 4 * (count.size() + offsets.size() + indices.size() + group_offsets.size() + group_indices.size());
  }
};

// Which lists of contributing lights are made: none, one for each pixel, or one for each group of pixels too
// that a subgroup of the device shades (shaders/shared/pixel_groups.h).
enum class LightLists { none, pixels, groups };

class DeviceFrame {
 public:
  DeviceFrame(gpu::Device& device, const Scene& scene, const FrameOptions& options, uint32_t width,
              uint32_t height);
  ~DeviceFrame();

  // Uploads view and lights of the frame, draws the g-buffer, and leaves the pictures that are shaded into
  // black: blocks where nothing is seen stay so.
  void load(const FrameInput& input);
  // Of the frame that is loaded.
  const OccupiedBlocks& occupied_blocks() const { return occupied_blocks_; }

  // Finds the contributing lights of the loaded frame (bounds of each 8x8 block's points against every light,
  // then every pixel against what is left). With `lists` their indices stay on the device for shading passes
  // that bind "ListOffsets" and "ListIndices", those of groups "GroupOffsets" and "GroupIndices"; all ascend.
  // Throws SystemError when the lists are larger than one storage buffer of the device.
  const ContributingLights& find_contributing(const FrameInput& input, LightLists lists);
  const ContributingLights& contributing() const { return contributing_; }
  // The lists that find_contributing() has just made, not none; and later, when the same frame is loaded again, in
  // its place: of contributing() only `count` is then there.
  SavedContributing save_contributing(LightLists lists);
  void restore_contributing(const SavedContributing& saved);

  gpu::Device& device() { return device_; }
  gpu::Commands& commands() { return commands_; }
  const FrameTargets& targets() const { return targets_; }
  const CounterTargets& counters();
  void clear_counters();  // records it; they must be there
  const FrameOptions& options() const { return options_; }
  // The resources that every shading pass may bind.
  gpu::Bindings bindings() const;
  const gpu::Buffer& view() const { return view_; }
  uint64_t light_bytes() const { return lights_.used() + extras_.used(); }
  uint64_t target_bytes() const;
  uint64_t shadow_map_bytes() const { return shadow_maps_ ? shadow_maps_->bytes() : 0; }
  // Null when there are none.
  const ShadowMaps* shadow_maps() const { return shadow_maps_.get(); }
  // Records the shadow maps, where there are any.
  void record_shadow_maps() {
    if (shadow_maps_) shadow_maps_->record(commands_, level_);
  }
  // Records the forward pass with this program of Level::forward_program. Only with the effect.
  void record_forward(const gpu::RasterProgram& program, const gpu::Bindings& bindings) {
    level_.record_forward(commands_, program, bindings, targets_);
  }

  // Reads a picture back, row by row.
  std::vector<uint32_t> read_words(const gpu::Image& image);
  std::vector<float> read_floats(const gpu::Image& image);
  // Position, normal, albedo, material or emission (only with the effect) of the g-buffer, four floats a
  // pixel (the fourth is the view depth, 0 for the sky).
  enum class Aov : uint32_t { position = 0, normal = 1, albedo = 2, material = 3, emission = 4 };
  std::vector<float> read_aov(Aov kind);

 private:
  void read_image(const gpu::Image& image);
  void clear_results();  // records it
  // The lists of pixels, which are on the device.
  std::span<const uint32_t> read_lists(size_t lights);
  // Merges the lists of pixels, which are on the device, into those of groups.
  void merge_groups(std::span<const uint32_t> offsets);

  gpu::Device& device_;
  FrameOptions options_;
  Level level_;
  FrameTargets targets_;
  std::unique_ptr<CounterTargets> counters_;
  std::unique_ptr<ShadowMaps> shadow_maps_;
  gpu::Commands commands_;
  gpu::Buffer view_;
  gpu::UploadBuffer lights_, extras_;
  OccupiedBlocks occupied_blocks_;
  std::unique_ptr<gpu::Buffer> readback_;
  struct ContributingPasses;
  std::unique_ptr<ContributingPasses> passes_;
  ContributingLights contributing_;
};

}  // namespace ml
