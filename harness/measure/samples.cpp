#include "harness/measure/samples.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "harness/base/check.h"
#include "harness/base/random.h"

namespace ml {

void SampleTable::set(std::string_view name, uint32_t repeat, uint32_t frame, double milliseconds) {
  ML_CHECK_LT(repeat, repeats_);
  ML_CHECK_LT(frame, frames_);
  auto found = tables_.find(name);
  if (found == tables_.end()) {
    std::vector<std::vector<double>> zeros(repeats_, std::vector<double>(frames_, 0.0));
    found = tables_.emplace(std::string(name), std::move(zeros)).first;
  }
  found->second[repeat][frame] = milliseconds;
}

SampleTable SampleTable::first(uint32_t repeats) const {
  SampleTable kept(std::min(repeats, repeats_), frames_);
  for (const auto& [name, laps] : tables_)
    kept.tables_[name].assign(laps.begin(), laps.begin() + kept.repeats_);
  return kept;
}

std::vector<double> SampleTable::all(std::string_view name) const {
  std::vector<double> samples;
  auto found = tables_.find(name);
  if (found == tables_.end()) return samples;
  for (const std::vector<double>& lap : found->second) samples.insert(samples.end(), lap.begin(), lap.end());
  return samples;
}

std::vector<uint32_t> interleaved_order(uint32_t cases, uint32_t seed, uint32_t lap, uint32_t frame) {
  std::vector<uint32_t> order(cases);
  std::iota(order.begin(), order.end(), 0u);
  // 64 bits of seed from two hashes, so that neighbouring laps and frames are unrelated.
  Random random(uint64_t{hash_u32(seed, lap, frame)} << 32 | hash_u32(frame, lap, seed));
  for (uint32_t left = cases; left > 1; --left) std::swap(order[left - 1], order[random.below(left)]);
  return order;
}

}  // namespace ml
