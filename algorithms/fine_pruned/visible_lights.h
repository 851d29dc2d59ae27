// Steps 1(a) and 1(b): the lights in view, sorted by type of shape.
#pragma once

#include <span>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/fine_pruned/pruned_lists.h"
#include "algorithms/froxels/binning.h"

namespace ml {

class VisibleLightList {
 public:
  // Leaves out what is outside the view. Span "cull".
  void cull(const FrameInput& frame, Spans& spans);
  // Direct lights, then probe lights; of both balls (omni, capsule), cones (spot, wedge), boxes; each type in
  // ascending order of index. At most `max_lights` lights are kept, the first ones in that order. Span
  // "sort".
  void sort(const FrameInput& frame, uint32_t max_lights, Spans& spans);

  uint32_t in_frustum() const { return static_cast<uint32_t>(visible_.count); }
  const gpu_data::VisibleHeader& header() const { return header_; }
  std::span<const uint32_t> lights() const { return std::span(sorted_).first(header_.count); }

  // Entries that the lists of all tiles have at most: the tiles of every ball's box. Not less than what the
  // device finds but for rounding at the edge of a tile.
  uint64_t max_entries_of_tiles(const FrameInput& frame);
  // The largest number of them in one tile, after max_entries_of_tiles().
  uint32_t max_in_a_tile();

 private:
  VisibleLights visible_;
  std::vector<LightBox> boxes_;
  uint32_t columns_ = 0, rows_ = 0;  // of tiles
  std::vector<int32_t> changes_;     // of the number of boxes from tile to tile
  std::vector<uint32_t> sorted_;
  gpu_data::VisibleHeader header_{};
};

}  // namespace ml
