// One setup of a run: its algorithms on the device, its counting lap and its timed laps.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "harness/bench/counting.h"
#include "harness/bench/run_log.h"
#include "harness/bench/workload.h"
#include "harness/output/result.h"

namespace ml {

nlohmann::json parameters_json(const Parameters& parameters);

class SetupRun {
 public:
  // `cases` belong to this setup. Throws UsageError and SystemError.
  SetupRun(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
           std::shared_ptr<const Scene> scene, RunLog& log);

  // Every step calls `done` with the number of (case, frame) samples it stands for.
  using Step = std::function<void(uint64_t samples, const std::string& what)>;
  void counting_lap(const Step& done);
  // Lap numbers from 0; the first config.measure.warmup ones are discarded.
  void timed_lap(uint32_t lap, const Step& done);
  // Heat maps and images into the folder, after the timing.
  void pictures(const std::filesystem::path& folder, const Step& done);

  const std::vector<CaseResult>& results() const { return results_; }
  std::vector<CaseResult>& results() { return results_; }
  Workload& workload() { return workload_; }

 private:
  void load(uint32_t index, bool lists);

  gpu::Device& device_;
  const Config& config_;
  std::vector<Case> cases_;
  RunLog& log_;
  Workload workload_;
  DeviceFrame frame_;
  std::vector<std::unique_ptr<ShadedAlgorithm>> algorithms_;
  std::vector<CaseResult> results_;
  std::vector<uint32_t> contradictions_;  // per case: samples whose times do not agree
  bool wants_lists_ = false;
  const FrameInput* input_ = nullptr;
  Spans spans_;
};

}  // namespace ml
