#include "algorithms/froxels/depth_order.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ml {

uint32_t depth_key(float z) {
  if (!(z > 0)) return 0;
  // Bits of positive floats ascend with their values; the sign is 0.
  return std::bit_cast<uint32_t>(z) >> (31 - depth_key_bits);
}

// One digit of a least-significant-digit radix sort. Runs are counted apart and scattered to where the
// earlier runs' items of the same digit end, so the result does not depend on their number.
void DepthOrder::scatter(const std::vector<Item>& from, std::vector<Item>& to, uint32_t shift, size_t runs,
                         Threads& threads) {
  auto digit = [shift](Item item) { return static_cast<uint32_t>(item >> shift) & (digits - 1); };
  auto begin_of = [&](size_t run) { return count_ * run / runs; };
  threads.for_each(runs, [&](size_t run) {
    Histogram& counts = histograms_[run];
    counts.fill(0);
    for (size_t i = begin_of(run); i < begin_of(run + 1); ++i) ++counts[digit(from[i])];
  });
  uint32_t running = 0;
  for (uint32_t d = 0; d < digits; ++d)
    for (size_t run = 0; run < runs; ++run) {
      uint32_t count = histograms_[run][d];
      histograms_[run][d] = running;
      running += count;
    }
  threads.for_each(runs, [&](size_t run) {
    Histogram& next = histograms_[run];
    for (size_t i = begin_of(run); i < begin_of(run + 1); ++i) to[next[digit(from[i])]++] = from[i];
  });
}

void DepthOrder::sort(std::span<const VisibleLights* const> parts, VisibleLights& sorted, Threads& threads) {
  count_ = 0;
  for (const VisibleLights* part : parts) count_ += part->count;
  sorted.reserve(count_);
  sorted.count = count_;
  if (items_.size() < count_) {
    items_.resize(count_ + count_ / 4);
    scratch_.resize(items_.size());
    light_of_rank_.resize(items_.size());
  }
  const size_t runs = parts.size();
  if (histograms_.size() < runs) histograms_.resize(runs);

  // With one part its own arrays are the gathered ones.
  const VisibleLights* source = parts[0];
  if (runs > 1) {
    gathered_.reserve(count_);
    source = &gathered_;
  }
  threads.for_each(runs, [&](size_t run) {
    const VisibleLights& part = *parts[run];
    size_t begin = 0;
    for (size_t before = 0; before < run; ++before) begin += parts[before]->count;
    for (size_t i = 0; i < part.count; ++i)
      items_[begin + i] = Item{depth_key(part.z[i])} << 32 | (begin + i);
    if (runs == 1) return;
    auto copy = [&](const auto& from, auto& to) {
      std::memcpy(to.data() + begin, from.data(), part.count * sizeof from[0]);
    };
    copy(part.x, gathered_.x);
    copy(part.y, gathered_.y);
    copy(part.z, gathered_.z);
    copy(part.radius, gathered_.radius);
    copy(part.index, gathered_.index);
  });
  scatter(items_, scratch_, 32, runs, threads);
  scatter(scratch_, items_, 32 + digit_bits, runs, threads);
  threads.for_each(runs, [&](size_t run) {
    for (size_t rank = count_ * run / runs; rank < count_ * (run + 1) / runs; ++rank) {
      auto place = static_cast<uint32_t>(items_[rank]);
      sorted.x[rank] = source->x[place];
      sorted.y[rank] = source->y[place];
      sorted.z[rank] = source->z[place];
      sorted.radius[rank] = source->radius[place];
      sorted.index[rank] = static_cast<uint32_t>(rank);
      light_of_rank_[rank] = source->index[place];
    }
  });
}

}  // namespace ml
