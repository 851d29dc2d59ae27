#include "algorithms/froxels/depth_order.h"

#include <algorithm>
#include <bit>

#include "algorithms/froxels/binning.h"
#include "harness/base/check.h"

namespace ml {

DepthKey::DepthKey(const gpu_data::ViewData& view)
    // A near plane at the camera, or behind it, would spend most keys on the last micrometre.
    : near_(std::bit_cast<uint32_t>(std::max(view.near, view.far * 1e-9f))), last_(0), shift_(0) {
  constexpr uint32_t octave = 1u << 23, largest = 0x7f7fffffu;  // in a float's bits; the largest finite float
  const uint32_t far = std::bit_cast<uint32_t>(std::max(view.near, view.far));
  while ((std::min(far + octave, largest) - near_) >> shift_ > max) ++shift_;
  last_ = static_cast<uint32_t>(std::min<uint64_t>(near_ + ((uint64_t{max} + 1) << shift_) - 1, largest));
}

uint32_t DepthKey::operator()(float z) const {
  // Negative numbers are negative as integers too; what is not a number is beyond all depths.
  const auto clamped =
      std::clamp(std::bit_cast<int32_t>(z), static_cast<int32_t>(near_), static_cast<int32_t>(last_));
  return (static_cast<uint32_t>(clamped) - near_) >> shift_;
}

// Runs are counted apart and scattered to where the earlier runs' items of the same digit end.
void DepthOrder::begin_of_digits(size_t runs, Histogram Run::*histogram) {
  uint32_t running = 0;
  for (uint32_t digit = 0; digit < digits; ++digit)
    for (size_t run = 0; run < runs; ++run) {
      uint32_t& next = (runs_[run].*histogram)[digit];
      running += next;
      next = running - next;
    }
}

void DepthOrder::sort(const float* z, std::span<const IndexRun> runs, const DepthKey& key, Threads& threads) {
  count_ = 0;
  size_t end = 0;
  for (const IndexRun& run : runs) {
    count_ += run.count;
    end = std::max(end, run.first + run.count);
  }
  ML_CHECK_LE(end, size_t{1} << 24);
  reserve_padded(keys_, end);
  reserve_padded(items_, count_);
  reserve_padded(indices_, count_);
  if (runs_.size() < runs.size()) runs_.resize(runs.size());
  const size_t count = runs.size();

  threads.for_each(count, [&](size_t r) {
    Run& run = runs_[r];
    run.low.fill(0);
    run.high.fill(0);
    // Keys by themselves, so that the compiler makes many at once.
    const size_t begin = runs[r].first, last = begin + runs[r].count;
    uint16_t* keys = keys_.data();
    for (size_t i = begin; i < last; ++i) keys[i] = static_cast<uint16_t>(key(z[i]));
    for (size_t i = begin; i < last; ++i) {
      ++run.low[keys[i] & 255];
      ++run.high[keys[i] >> 8];
    }
  });
  begin_of_digits(count, &Run::low);
  threads.for_each(count, [&](size_t r) {
    Histogram& next = runs_[r].low;
    for (size_t i = runs[r].first; i < runs[r].first + runs[r].count; ++i)
      items_[next[keys_[i] & 255]++] = uint32_t{keys_[i]} >> 8 << 24 | static_cast<uint32_t>(i);
  });
  // The second pass runs over other items than the first when there are several runs.
  auto begin_of = [&](size_t r) { return count_ * r / count; };
  if (count > 1)
    threads.for_each(count, [&](size_t r) {
      Histogram& counts = runs_[r].high;
      counts.fill(0);
      for (size_t i = begin_of(r); i < begin_of(r + 1); ++i) ++counts[items_[i] >> 24];
    });
  begin_of_digits(count, &Run::high);
  threads.for_each(count, [&](size_t r) {
    Histogram& next = runs_[r].high;
    for (size_t i = begin_of(r); i < begin_of(r + 1); ++i)
      indices_[next[items_[i] >> 24]++] = items_[i] & 0xffffffu;
  });
}

}  // namespace ml
