#include "harness/bench/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/base/folder_lock.h"
#include "harness/bench/context.h"
#include "harness/bench/estimate.h"
#include "harness/bench/interruption.h"
#include "harness/bench/progress.h"
#include "harness/bench/setup_run.h"
#include "scenes/load_scene.h"

namespace ml {
namespace {

// Cases by setup, in order.
std::map<size_t, std::vector<Case>> by_setup(const std::vector<Case>& cases) {
  std::map<size_t, std::vector<Case>> groups;
  for (const Case& item : cases) groups[item.setup].push_back(item);
  return groups;
}

std::filesystem::path result_file(const RunOptions& options) {
  return options.out / "result.json";
}

// The complete cases of an earlier run of the same configuration.
std::vector<nlohmann::json> earlier_cases(const Config& config, const RunOptions& options) {
  const std::filesystem::path file = result_file(options);
  if (!options.resume || !std::filesystem::exists(file)) return {};
  nlohmann::json earlier = read_result(file);
  if (earlier["config"] != config.resolved)
    throw UsageError(
        file.string() +
        ": is the result of another configuration; choose another folder or replace it with --force");
  std::vector<nlohmann::json> complete;
  for (const nlohmann::json& item : earlier["cases"])
    if (item["repeats_done"] == config.measure.repeats) complete.push_back(item);
  return complete;
}

// Writes the result after each step and throws when the validation layer has spoken.
class Recorder {
 public:
  Recorder(Result& result, const RunOptions& options, gpu::Device& device, RunLog& log)
      : result_(result), options_(options), device_(device), log_(log) {}

  void write(const std::vector<CaseResult>& finished, const std::vector<CaseResult>& current, bool complete) {
    auto span = log_.span("writing");
    for (const std::string& message : device_.validation_messages())
      throw std::runtime_error("validation layer: " + one_line(message));
    result_.cases = finished;
    result_.cases.insert(result_.cases.end(), current.begin(), current.end());
    result_.complete = complete;
    result_.harness = log_.summary();
    result_.harness["peak_memory_bytes"] = peak_memory_bytes();
    const Uninterrupted guard;
    write_result(result_, result_file(options_));
  }

 private:
  Result& result_;
  const RunOptions& options_;
  gpu::Device& device_;
  RunLog& log_;
};

// The steps of a case of the setup, as planned and as done.
double expected_seconds(const CaseSeconds& seconds, StepKind kind) {
  switch (kind) {
    case StepKind::programs:
      return seconds.programs + seconds.counting;
    case StepKind::timing:
      return seconds.timing;
    default:
      return seconds.counting;
  }
}

// Pictures of a frame, where they are asked for, are counted once more.
uint64_t picture_frames(const Config& config) {
  std::set<uint32_t> frames(config.outputs.heatmaps.begin(), config.outputs.heatmaps.end());
  frames.insert(config.outputs.images.begin(), config.outputs.images.end());
  return frames.size();
}

void plan_case(const Config& config, const Case& item, const CaseSeconds& seconds, Progress& progress) {
  const uint64_t frames = config.setups[item.setup].camera.frames;
  const uint64_t steps[] = {1, frames - 1, frames * (config.measure.warmup + config.measure.repeats),
                            picture_frames(config)};
  const StepKind kinds[] = {StepKind::programs, StepKind::counting, StepKind::timing, StepKind::pictures};
  for (size_t i = 0; i < 4; ++i) progress.plan(kinds[i], expected_seconds(seconds, kinds[i]), steps[i]);
}

}  // namespace

std::vector<Case> selected_cases(const Config& config, const RunOptions& options) {
  std::vector<Case> cases = expand_cases(config);
  std::erase_if(cases, [&](const Case& item) { return item.setup % options.shards != options.shard; });
  try {
    std::regex filter(options.filter);
    std::erase_if(cases, [&](const Case& item) { return !std::regex_search(item.id, filter); });
  } catch (const std::regex_error& error) {
    throw UsageError("--filter '" + options.filter + "': not a regular expression: " + error.what());
  }
  if (cases.empty()) throw UsageError("no case is left by --filter '" + options.filter + "' and --shard");
  return cases;
}

void check_output(const RunOptions& options) {
  const std::filesystem::path file = result_file(options);
  if (options.resume || options.force || !std::filesystem::exists(file)) return;
  throw UsageError(file.string() +
                   ": there is a result already; --resume goes on with it, --force replaces it, --out names "
                   "another folder");
}

void check_inputs(const Config& config, const std::vector<Case>& cases) {
  std::vector<const Setup*> setups;
  for (const auto& [index, group] : by_setup(cases)) setups.push_back(&config.setups[index]);
  check_workloads(setups);
}

Result run_config(const Config& config, const RunOptions& options) {
  std::vector<Case> cases = selected_cases(config, options);
  make_output_directory(options.out);
  const FolderLock lock(options.out, "run.lock");
  check_output(options);
  Result result;
  result.earlier_cases = earlier_cases(config, options);
  std::erase_if(cases, [&](const Case& item) {
    return std::any_of(result.earlier_cases.begin(), result.earlier_cases.end(),
                       [&](const nlohmann::json& earlier) { return earlier["id"] == item.id; });
  });

  const std::map<size_t, std::vector<Case>> groups = by_setup(cases);
  RunLog log(config.outputs.trace);
  std::shared_ptr<const Scene> scene;
  SceneSpec scene_spec;
  {
    auto span = log.span("scene");
    std::vector<const Setup*> setups;
    for (const auto& [index, group] : groups) setups.push_back(&config.setups[index]);
    scene = check_workloads(setups);
    if (!setups.empty()) scene_spec = setups.front()->scene;
  }
  std::optional<gpu::Device> device;
  {
    auto span = log.span("device");
    device.emplace(gpu::DeviceOptions{options.device, options.validation});
    result.context = run_context(*device, calibrate(*device));
  }
  result.config = config.resolved;
  if (!options.quiet)
    fmt::print("device: {} ({}, {})\n", device->info().name, device->info().type, device->info().driver);
  const nlohmann::json& calibration = result.context["calibration"];
  Recorder recorder(result, options, *device, log);
  Progress progress(config.name, options.quiet);
  for (const Case& item : cases) plan_case(config, item, case_seconds(config, item, cases), progress);

  std::vector<CaseResult> finished;
  KeptFrame kept;
  for (const auto& [index, group] : groups) {
    const Setup& setup = config.setups[index];
    if (scene && !(scene_spec == setup.scene)) scene = nullptr;
    SetupRun run(*device, config, group, scene, kept, log);
    scene = run.workload().scene();
    scene_spec = setup.scene;
    std::vector<CaseSeconds> expected;
    for (const Case& item : group) expected.push_back(case_seconds(config, item, group));
    auto step = [&](StepKind kind, size_t item, const std::string& what) {
      progress.advance(kind, expected_seconds(expected[item], kind), what);
    };
    auto settle = [&] {
      for (CaseResult& item : run.results())
        if (!calibration["agrees"].get<bool>()) {
          item.timing_suspect = true;
          item.timing_note = "calibration: " + calibration["note"].get<std::string>();
        }
    };
    try {
      run.counting_lap(step, !options.quiet);
      recorder.write(finished, run.results(), false);
      for (uint32_t lap = 0; lap < config.measure.warmup + config.measure.repeats; ++lap) {
        const Clock::time_point begin = Clock::now();
        run.timed_lap(lap, step);
        if (lap >= config.measure.warmup) log.add_timed_lap(milliseconds_between(begin, Clock::now()));
        settle();
        if (lap >= config.measure.warmup) recorder.write(finished, run.results(), false);
      }
      run.pictures(options.out, step);
    } catch (const Interrupted&) {
      settle();
      recorder.write(finished, run.results(), false);
      throw;
    }
    finished.insert(finished.end(), run.results().begin(), run.results().end());
    recorder.write(finished, {}, false);
  }
  if (config.outputs.trace) {
    auto span = log.span("writing");
    write_trace(log.events(), fmt::format("{} ({})", device->info().name, device->info().type),
                options.out / "trace.json");
  }
  recorder.write(finished, {}, true);
  return result;
}

}  // namespace ml
