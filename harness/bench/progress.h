// Progress of long work: one rewritten line with the time left on a terminal, a plain line now and then
// elsewhere.
#pragma once

#include <cstdint>
#include <string>

#include "harness/base/spans.h"
#include "harness/bench/time_left.h"

namespace ml {

class Progress {
 public:
  // `quiet` prints nothing.
  explicit Progress(std::string title, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Steps to come, before the first is done.
  void plan(StepKind kind, double expected_seconds, uint64_t steps = 1);
  // A step is done. It took the time since the last one. `what` names the work at hand.
  void advance(StepKind kind, double expected_seconds, const std::string& what);

 private:
  void print(const std::string& what, bool last);
  std::string title_;
  TimeLeft time_;
  uint64_t steps_ = 0, done_ = 0;
  bool quiet_, terminal_;
  bool line_open_ = false;
  Clock::time_point begin_, advanced_, printed_;
};

}  // namespace ml
