// What a run will cost, before it is run.
#pragma once

#include <string>
#include <vector>

#include "harness/config/config.h"

namespace ml {

struct Estimate {
  double seconds = 0;         // on two cores of a software device; a real GPU takes a small part of it
  uint64_t memory_bytes = 0;  // targets, lists of contributing lights and counters of the largest setup
};

// Seconds that the steps of a case are expected to take, its share of what all cases of its setup need in
// common included.
struct CaseSeconds {
  double programs = 0;
  double counting = 0;  // of one frame
  double timing = 0;    // of one frame
};
CaseSeconds case_seconds(const Config& config, const Case& item, const std::vector<Case>& cases);

// From pixels, lights, laps and frames, with costs per unit measured on a software device of two cores.
Estimate estimate_run(const Config& config, const std::vector<Case>& cases);

// One line a case, and the estimate.
std::string describe_cases(const Config& config, const std::vector<Case>& cases);

}  // namespace ml
