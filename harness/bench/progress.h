// Progress of long work: one rewritten line with the time left on a terminal, a plain line now and then
// elsewhere.
#pragma once

#include <cstdint>
#include <string>

#include "harness/base/spans.h"

namespace ml {

class Progress {
 public:
  // `total` steps of about equal cost; `quiet` prints nothing.
  Progress(std::string title, uint64_t total, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `steps` more are done; `what` names the work at hand.
  void advance(uint64_t steps, const std::string& what);

 private:
  void print(const std::string& what, bool last);
  std::string title_;
  uint64_t total_, done_ = 0;
  bool quiet_, terminal_;
  bool line_open_ = false;
  Clock::time_point begin_, printed_;
};

}  // namespace ml
