// The global sort of Tiled Light Trees (section 3.2): visible lights in the order of their centres' depth, so
// that the list of every tile or froxel is sorted when it is written.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/parallel.h"
#include "shaders/shared/view.h"

namespace ml {

// Depth as a number of 16 bits to sort by: steps of 1/2048 of the depth or finer while near and far are not
// more than 29 octaves apart. Centres before the near plane are 0. Those beyond the far depth are sorted by
// the same steps for an octave or more, as far as the numbers reach, and only what lies farther away is
// 65535: a tree over lights of one key would be no better than a list. Trees stay right for any order of
// their lights, only their bounds grow; steps this fine change none noticeably.
class DepthKey {
 public:
  static constexpr uint32_t bits = 16, max = (1u << bits) - 1;
  explicit DepthKey(const gpu_data::ViewData& view);
  uint32_t operator()(float z) const;

 private:
  uint32_t near_, last_, shift_;  // bits of positive floats, which ascend with their values
};

// A run of visible lights: elements [first, first + count) of arrays that all runs share.
struct IndexRun {
  size_t first, count;
};

class DepthOrder {
 public:
  // Radix sort, least significant byte first. `z`: view depths by index; `runs`: the indices in use,
  // ascending, below 2^24. Lights of equal keys keep their order, so the result does not depend on the number
  // of runs.
  void sort(const float* z, std::span<const IndexRun> runs, const DepthKey& key, Threads& threads);

  // The index of each rank; vector padding after them.
  std::span<const uint32_t> indices() const { return std::span(indices_).first(count_); }

 private:
  static constexpr uint32_t digits = 256;
  using Histogram = std::array<uint32_t, digits>;
  struct Run {
    Histogram low, high;  // counts, then where the next item of the digit goes
  };
  void begin_of_digits(size_t runs, Histogram Run::*histogram);

  size_t count_ = 0;
  std::vector<uint16_t> keys_;
  // Upper byte of the key above 24 bits of index, in the order of the lower byte.
  std::vector<uint32_t> items_, indices_;
  std::vector<Run> runs_;
};

}  // namespace ml
