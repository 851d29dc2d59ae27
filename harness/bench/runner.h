// `run`: carries the cases of a configuration through their laps and writes the result.
#pragma once

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "harness/config/config.h"
#include "harness/gpu/device.h"
#include "harness/output/result.h"

namespace ml {

struct RunOptions {
  std::filesystem::path out;  // folder of result.json and its files
  std::string filter;         // ECMAScript regular expression searched in case ids; empty: all
  std::string device;         // selector, see gpu::DeviceOptions
  bool resume = false;  // keep the complete cases of a result with the same configuration that is in `out`
  bool force = false;   // replace a result that is in `out`
  uint32_t shard = 0, shards = 1;  // only the setups with number % shards == shard
  bool validation = false;         // validation layers: for tests; the result says so
  bool quiet = false;              // no progress, and nothing of what the level brings but in the result
};

// The cases that are left by filter and shard, in order. Throws UsageError for a filter that is no regular
// expression or leaves nothing.
std::vector<Case> selected_cases(const Config& config, const RunOptions& options);

// Refuses a folder that holds a result which the options neither go on with nor replace: UsageError.
void check_output(const RunOptions& options);

// Loads what the cases need and lets it go again, as a run does before any other work: UsageError for what
// cannot be had.
void check_inputs(const Config& config, const std::vector<Case>& cases);

// Runs; every finished lap is on the disk as a valid result with "complete": false. Throws Interrupted after
// a signal, with what was measured written; SystemError and UsageError before any time was measured for the
// setup at hand, and a folder that another run writes into (SystemError). Messages of the validation layer
// end the run (std::runtime_error).
Result run_config(const Config& config, const RunOptions& options);

}  // namespace ml
