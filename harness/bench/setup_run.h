// One setup of a run: its algorithms on the device, its counting lap and its timed laps.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "harness/bench/counting.h"
#include "harness/bench/run_log.h"
#include "harness/bench/time_left.h"
#include "harness/bench/workload.h"
#include "harness/output/result.h"

namespace ml {

nlohmann::json parameters_json(const Parameters& parameters);

// The device's frame of the setup before: a sweep's points whose level, effects and resolution are the same
// share it, with the level's buffers and the g-buffer. Empty before the first.
struct KeptFrame {
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<DeviceFrame> frame;
};

class SetupRun {
 public:
  // `cases` belong to this setup. `kept` outlives it. Throws UsageError and SystemError.
  SetupRun(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
           std::shared_ptr<const Scene> scene, KeptFrame& kept, RunLog& log);

  // Every step calls `done` with the index of its case among `cases`.
  using Step = std::function<void(StepKind kind, size_t index, const std::string& what)>;
  // Also tells on stderr, where `tell`, what the level brings and what of it is used. UsageError when no
  // frame sees a surface.
  void counting_lap(const Step& done, bool tell);
  // Lap numbers from 0; the first config.measure.warmup ones are discarded.
  void timed_lap(uint32_t lap, const Step& done);
  // Heat maps and images into the folder, after the timing.
  void pictures(const std::filesystem::path& folder, const Step& done);

  const std::vector<CaseResult>& results() const { return results_; }
  std::vector<CaseResult>& results() { return results_; }
  Workload& workload() { return workload_; }

 private:
  // `lists`: finds the contributing lights, in the lap before which nothing is known of them.
  void load(uint32_t index, bool lists);
  // The same frame in later laps: what was found is uploaded, or found again where it was too much to keep.
  void load_again(uint32_t index);
  void keep_lists(uint32_t index);
  // Marks the case as invalid, with an error line, when the counters of the frame at hand cannot be right.
  void check_counts(size_t i, const PixelCounts& counts, const std::vector<uint8_t>& lit,
                    const ViewDepths& depths, const FrameCounters& counters);

  gpu::Device& device_;
  const Config& config_;
  std::vector<Case> cases_;
  RunLog& log_;
  Workload workload_;
  DeviceFrame& frame_;
  std::vector<std::unique_ptr<ShadedAlgorithm>> algorithms_;
  std::vector<CaseResult> results_;
  std::vector<uint32_t> contradictions_;  // per case: samples whose times do not agree
  LightLists lists_ = LightLists::none;   // the most that a case wants
  const FrameInput* input_ = nullptr;
  std::map<uint32_t, SavedContributing> saved_;  // by frame
  size_t saved_bytes_ = 0;
  Spans spans_;
};

}  // namespace ml
