// The global sort of Tiled Light Trees (section 3.2): visible lights in the order of their centres' depth, so
// that the list of every tile or froxel is sorted when it is written.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/froxels/binning.h"
#include "harness/base/parallel.h"

namespace ml {

// Depth as a number to sort by: 22 bits, in steps of 1/8192 of the depth. Centres behind the camera are 0.
// Trees stay right for any order of their lights, only their bounds grow; steps this fine change none
// noticeably.
inline constexpr uint32_t depth_key_bits = 22;
uint32_t depth_key(float z);

class DepthOrder {
 public:
  // Gathers the lights of `parts`, one after the other, into `sorted`, in ascending order of depth key;
  // lights of equal keys keep their order. sorted.index[rank] is the rank; light_of_rank()[rank] the light's
  // index.
  void sort(std::span<const VisibleLights* const> parts, VisibleLights& sorted, Threads& threads);

  std::span<const uint32_t> light_of_rank() const { return std::span(light_of_rank_).first(count_); }

 private:
  static constexpr uint32_t digit_bits = depth_key_bits / 2, digits = 1u << digit_bits;
  using Histogram = std::array<uint32_t, digits>;
  // Key in the upper half, place among the gathered lights in the lower.
  using Item = uint64_t;
  void scatter(const std::vector<Item>& from, std::vector<Item>& to, uint32_t shift, size_t runs,
               Threads& threads);

  size_t count_ = 0;
  std::vector<Item> items_, scratch_;
  std::vector<Histogram> histograms_;
  VisibleLights gathered_;
  std::vector<uint32_t> light_of_rank_;
};

}  // namespace ml
