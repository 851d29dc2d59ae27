// Raw samples of one case and the plan of who is measured when. No Vulkan here.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ml {

// Milliseconds as [repeat][frame], by span name.
class SampleTable {
 public:
  SampleTable() = default;
  SampleTable(uint32_t repeats, uint32_t frames) : repeats_(repeats), frames_(frames) {}
  // A name's first sample makes its table; slots never filled stay 0, and an unfinished last lap is cut by
  // first(). `repeat` and `frame` must be within the table.
  void set(std::string_view name, uint32_t repeat, uint32_t frame, double milliseconds);
  const std::map<std::string, std::vector<std::vector<double>>, std::less<>>& tables() const {
    return tables_;
  }
  // The first `repeats` laps only: what an interrupted run keeps.
  SampleTable first(uint32_t repeats) const;
  uint32_t repeats() const { return repeats_; }
  uint32_t frames() const { return frames_; }
  // All samples of one name, in order (repeat by repeat); empty when there is none.
  std::vector<double> all(std::string_view name) const;

 private:
  uint32_t repeats_ = 0, frames_ = 0;
  std::map<std::string, std::vector<std::vector<double>>, std::less<>> tables_;
};

// Order in which the cases of one frame are measured: a seeded shuffle for every (lap, frame), so that drift
// hits all alike.
std::vector<uint32_t> interleaved_order(uint32_t cases, uint32_t seed, uint32_t lap, uint32_t frame);

}  // namespace ml
