// The counting lap: exact work counters of a frame, and the proof that no light was lost.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/frame/shaded_algorithm.h"

namespace ml {

// Per-pixel numbers of one frame of one case, row by row.
struct PixelCounts {
  std::vector<uint32_t> listed, tested, contributing, nodes, hash, traversal;
};

PixelCounts read_counts(DeviceFrame& frame);

// Frame totals and means as the result has them.
struct FrameCounters {
  uint64_t lit_pixels = 0;  // pixels with a surface
  uint64_t lost = 0;        // contributing lights that were not evaluated, over all pixels
  uint64_t mismatched_pixels =
      0;  // pixels whose set of contributing lights differs in any way (lost, twice, wrong)
  uint64_t list_pixels = 0,
           tree_pixels = 0;  // lit pixels that walked a list, a tree; 0 where there are no trees
  double listed = 0, tested = 0, contributing = 0, nodes = 0;  // means over lit pixels
  PrepareCounters prepare;
  // Names as in the result's `counters`.
  std::map<std::string, double> named() const;
};

// `lit` has one flag a pixel; `truth` is what contributes.
FrameCounters summarize(const PixelCounts& counts, const ContributingLights& truth,
                        const std::vector<uint8_t>& lit, const PrepareCounters& prepare);

// The frame's values of the counters that the algorithm declares, all of them: those of pixels as means over
// lit pixels. std::logic_error where it declares one that it does not give, or the other way round.
std::map<std::string, double> own_counters(const AlgorithmInfo& info, const CounterValues& of_frame,
                                           const std::map<std::string, std::vector<uint32_t>>& of_pixels,
                                           const std::vector<uint8_t>& lit);

// Why the counters of a frame cannot be right, whatever the lists are; empty when they may be. The reference
// tests every light at every pixel with a surface, `ideal` lists and tests what contributes to the pixel or,
// where it walks `LightLists::groups`, to some pixel of its group, and nobody lists more lights than there
// are, evaluates what it has not listed, or counts where there is no surface.
std::string miscounted(const AlgorithmInfo& info, const PixelCounts& counts, const ContributingLights& truth,
                       const std::vector<uint8_t>& lit, size_t lights, LightLists walk);

// How many lights the list of a pixel holds at a view depth (m), where that is known
// (Algorithm::lights_listed).
using ListLength = std::function<std::optional<uint32_t>(glm::uvec2 pixel, float depth)>;
// View depths of the surface points of a frame. A device may round them otherwise: by so many metres, or this
// part of the depth.
struct ViewDepths {
  std::vector<float> depth;  // m, row by row; 0: sky
  uint32_t width = 0;        // px
  float absolute = 0, relative = 1e-6f;
};
// Of the loaded frame.
ViewDepths view_depths(DeviceFrame& frame, const gpu_data::ViewData& view);
// Why what pixels listed cannot be right: it is not what their lists hold; empty when it is, or when nobody
// knows. Within rounding of the boundary of two cells either list is right.
std::string mislisted(const PixelCounts& counts, const ViewDepths& depths, const ListLength& list);

// Which pixels of the loaded frame have a surface.
std::vector<uint8_t> lit_pixels(DeviceFrame& frame);

}  // namespace ml
