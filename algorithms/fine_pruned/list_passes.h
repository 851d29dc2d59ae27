// Steps 1(c) and 2 on the device: its programs and buffers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/fine_pruned/pruned_lists.h"
#include "harness/gpu/commands.h"

namespace ml {

struct PruneSettings {
  bool packed = false;  // the chapter's lists and limits
  uint32_t prune = ML_PRUNE_FINE;
  uint32_t bounds = ML_BOUNDS_HULL;
  bool tile_depths = true;     // false: coarse lists by the tiles' rectangles alone
  bool probes = false;         // a list of probe lights beside that of direct ones
  uint32_t region_lights = 0;  // with more lights in view than this, regions of tiles list lights first
  uint32_t packed_words() const { return (probes ? 2 : 1) * ML_PACKED_WORDS; }  // of a tile
};

class ListPasses {
 public:
  ListPasses(gpu::Device& device, const gpu::Constants& shared, const PruneSettings& settings);

  // Records the passes. `frame` binds the frame's resources and "Visible"; `entries`: lights that the lists
  // of all tiles hold at most.
  void record(gpu::Commands& commands, const gpu_data::ViewData& view, const gpu::Bindings& frame,
              uint32_t visible, uint64_t entries);
  // "TileLists", "ListLights", "PackedLists" and what else the passes write.
  void bindings(gpu::Bindings& list) const;

  // Sums over the tiles of the last frame, read back.
  struct Counts {
    uint64_t tiles = 0, coarse = 0, listed = 0, overflow_tiles = 0, overflow_lights = 0;
  };
  Counts read(gpu::Commands& commands);
  // Lights in the lists of the pixel's tile, of the frame that was read back last.
  uint32_t listed(glm::uvec2 pixel) const;

 private:
  struct Grown {
    const char* name;
    std::unique_ptr<gpu::Buffer> buffer;
  };
  // The passes over tiles, by themselves or after the pass over regions. Made when first needed.
  struct TilePrograms {
    std::unique_ptr<gpu::ComputeProgram> count, lists;  // count: none when packed
  };
  void reserve(Grown& grown, uint64_t bytes);
  TilePrograms& programs(bool regions);
  // Regions as small as the memory for their lists allows.
  void lay_out_regions(uint32_t columns, uint32_t rows, uint32_t visible);

  gpu::Device& device_;
  PruneSettings settings_;
  gpu::Constants shared_;
  gpu::ComputeProgram bounds_;
  std::unique_ptr<gpu::ComputeProgram> offsets_, regions_;  // none when packed; when not needed yet
  TilePrograms flat_, in_regions_;
  Grown light_bounds_{"Bounds", {}}, tile_lists_{"TileLists", {}}, list_lights_{"ListLights", {}},
      packed_lists_{"PackedLists", {}}, tile_counts_{"TileCounts", {}}, region_lists_{"RegionLists", {}};
  std::unique_ptr<gpu::Buffer> readback_;
  std::vector<uint32_t> listed_;  // of each tile, read back
  uint32_t columns_ = 0, tiles_ = 0;
  uint32_t region_shift_ = 0, region_columns_ = 0, region_rows_ = 0;
};

}  // namespace ml
