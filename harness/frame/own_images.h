// The images of an algorithm's own: what its device half declares (DeviceAlgorithm::images), and in counting
// laps a picture for each of its per-pixel counters. Made when first needed, at the resolution of the frame.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "algorithms/device_algorithm.h"
#include "harness/frame/device_frame.h"

namespace ml {

class OwnImages {
 public:
  OwnImages(std::vector<OwnImage> declared, const std::vector<CounterInfo>& counters, std::string algorithm);

  // How the frame that comes follows on the one before: histories change places, or begin anew.
  void follow(Step step);
  // Makes what is not there yet and records what has to be cleared; then adds all to `list`.
  void bind(DeviceFrame& frame, bool counting, gpu::Bindings& list);

  // Of the counting lap before, by the counter's name.
  std::map<std::string, std::vector<uint32_t>> read_counters(DeviceFrame& frame) const;
  // An image that is not null when a frame has been recorded; of a history the one of that frame.
  const gpu::Image* find(const std::string& name) const;
  uint64_t bytes() const;

 private:
  struct Kept {
    OwnImage info;
    std::string before;                              // NAME + "Before"
    std::array<std::unique_ptr<gpu::Image>, 2> two;  // the second one with history only
  };
  void make(DeviceFrame& frame, bool counting);

  std::string algorithm_;
  std::vector<Kept> images_;
  std::vector<std::pair<std::string, std::unique_ptr<gpu::Image>>> counters_;
  uint32_t width_ = 0, height_ = 0;
  uint32_t current_ = 0;
  bool begins_ = true;  // histories are cleared with the next frame
};

}  // namespace ml
