#include "harness/bench/setup_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/bench/bookkeeping.h"
#include "harness/bench/calibration.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/interruption.h"
#include "harness/bench/overlap.h"

namespace ml {
namespace {

const Setup& setup_of(const Config& config, const std::vector<Case>& cases) {
  return config.setups[cases.front().setup];
}

CaseResult empty_result(const gpu::Device& device, const Config& config, const Case& item,
                        Workload& workload) {
  const Setup& setup = config.setups[item.setup];
  const AlgorithmSpec& algorithm = setup.algorithms[item.algorithm];
  CaseResult result;
  result.id = item.id;
  result.algorithm = algorithm.name;
  result.parameters = parameters_json(algorithm.parameters);
  result.scene = setup.scene_label;
  result.lights = static_cast<uint32_t>(workload.lights().base().size());
  result.width = setup.width;
  result.height = setup.height;
  result.effects = workload.options().names(device);
  for (uint32_t i = 0; i < setup.camera.frames; ++i) result.frames.push_back(i);
  result.cpu_ms = result.gpu_ms = SampleTable(config.measure.repeats, setup.camera.frames);
  keep_books(workload, result);
  return result;
}

}  // namespace

nlohmann::json parameters_json(const Parameters& parameters) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& entry : parameters.values())
    std::visit([&](const auto& value) { json[entry.first] = value; }, entry.second);
  return json;
}

namespace {

// Of lists of contributing lights that are kept from lap to lap.
constexpr size_t max_saved_bytes = size_t{256} << 20;

// The kept frame where it fits the workload, else a new one in its place.
DeviceFrame& frame_for(gpu::Device& device, Workload& workload, KeptFrame& kept) {
  const uint32_t width = workload.frames().width(), height = workload.frames().height();
  if (kept.frame && kept.scene == workload.scene() && kept.frame->options() == workload.options() &&
      kept.frame->targets().width() == width && kept.frame->targets().height() == height)
    return *kept.frame;
  kept.frame.reset();  // before the new one takes as much memory
  kept.frame = std::make_unique<DeviceFrame>(device, *workload.scene(), workload.options(), width, height);
  kept.scene = workload.scene();
  return *kept.frame;
}

}  // namespace

SetupRun::SetupRun(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
                   std::shared_ptr<const Scene> scene, KeptFrame& kept, RunLog& log)
    : device_(device),
      config_(config),
      cases_(cases),
      log_(log),
      workload_([&] {
        auto span = log.span("scene");
        return Workload(setup_of(config, cases), config.measure.threads, std::move(scene));
      }()),
      frame_([&]() -> DeviceFrame& {
        auto span = log.span("programs");
        return frame_for(device, workload_, kept);
      }()) {
  auto span = log_.span("programs");
  for (const Case& item : cases_) {
    const AlgorithmSpec& spec = setup_of(config_, cases_).algorithms[item.algorithm];
    const AlgorithmEntry& entry = find_algorithm(spec.name, item.id);
    algorithms_.push_back(
        std::make_unique<ShadedAlgorithm>(device_, entry, spec.parameters, workload_.options()));
    lists_ = std::max(lists_, algorithms_.back()->wanted_lists());
    results_.push_back(empty_result(device_, config_, item, workload_));
    for (const PassInfo& pass : entry.info.passes) results_.back().passes[pass.name] = word_of(pass.kind);
    results_.back().overlap = expected_overlap(device_, setup_of(config_, cases_).shading, entry.info,
                                               config_.measure, workload_.frames().frames());
  }
  contradictions_.assign(cases_.size(), 0);
}

void SetupRun::load(uint32_t index, bool lists) {
  stop_if_interrupted();
  {
    auto span = log_.span("lights");
    input_ = &workload_.frames().at(index);
  }
  {
    auto span = log_.span("g-buffer");
    frame_.load(*input_);
  }
  if (lists) {
    auto span = log_.span("contributing lights");
    frame_.find_contributing(*input_, lists_);
  }
}

void SetupRun::keep_lists(uint32_t index) {
  if (lists_ == LightLists::none || saved_bytes_ > max_saved_bytes) return;
  auto span = log_.span("contributing lights");
  SavedContributing& saved = saved_[index] = frame_.save_contributing(lists_);
  saved_bytes_ += saved.bytes();
}

void SetupRun::load_again(uint32_t index) {
  const auto saved = saved_.find(index);
  load(index, lists_ != LightLists::none && saved == saved_.end());
  if (saved == saved_.end()) return;
  auto span = log_.span("contributing lights");
  frame_.restore_contributing(saved->second);
}

void SetupRun::check_counts(size_t i, const PixelCounts& counts, const std::vector<uint8_t>& lit,
                            const ViewDepths& depths, const FrameCounters& counters) {
  CaseResult& result = results_[i];
  if (result.invalid) return;
  const AlgorithmInfo& info = algorithms_[i]->info();
  result.invalid_note = miscounted(info, counts, frame_.contributing(), lit, input_->lights.count(),
                                   algorithms_[i]->wanted_lists());
  if (result.invalid_note.empty())
    result.invalid_note = mislisted(counts, depths, [&](glm::uvec2 pixel, float depth) {
      return algorithms_[i]->lights_listed(pixel, depth);
    });
  // What the user's caps cut off is counted and told.
  if (result.invalid_note.empty() && info.exact && counters.mismatched_pixels > 0 &&
      counters.prepare.overflow_lights == 0)
    result.invalid_note = fmt::format("{} lights are lost, and {} pixels have others than they should",
                                      counters.lost, counters.mismatched_pixels);
  result.invalid = !result.invalid_note.empty();
  if (result.invalid) {
    result.invalid_note += fmt::format(", in frame {}", input_->index);
    fmt::print(stderr, "manylights: {}: the case is invalid: {}\n", result.id, result.invalid_note);
  }
}

void SetupRun::counting_lap(const Step& done, bool tell) {
  uint32_t unseen = 0;
  for (uint32_t index = 0; index < workload_.frames().frames(); ++index) {
    load(index, true);
    keep_lists(index);
    unseen += frame_.occupied_blocks().positions().empty();
    std::vector<uint8_t> lit;
    ViewDepths depths;
    {
      auto span = log_.span("counting");
      lit = lit_pixels(frame_);
      depths = view_depths(frame_, input_->view);
    }
    for (size_t i = 0; i < cases_.size(); ++i) {
      stop_if_interrupted();
      auto span = log_.span("counting");
      spans_.clear();
      algorithms_[i]->prepare(*input_, spans_, frame_.occupied_blocks().positions());
      algorithms_[i]->count(frame_, *input_);
      // Drivers finish compiling a program at its first dispatch; that must not be in the first sample,
      // warm-up laps or not.
      if (index == 0) algorithms_[i]->shade(frame_, *input_, gpu::Timing::none);
      const PixelCounts counts = read_counts(frame_);
      const FrameCounters counters =
          summarize(counts, frame_.contributing(), lit, algorithms_[i]->counters());
      check_counts(i, counts, lit, depths, counters);
      for (const auto& [name, value] : counters.named()) results_[i].counters[name].push_back(value);
      for (const auto& [name, value] : own_counters(algorithms_[i]->info(), algorithms_[i]->own_counters(),
                                                    algorithms_[i]->own_pixel_counters(frame_), lit))
        results_[i].counters[name].push_back(value);
      done(index == 0 ? StepKind::programs : StepKind::counting, i, "counting " + cases_[i].id);
    }
  }
  const Setup& setup = setup_of(config_, cases_);
  require_surface(setup, unseen, workload_.frames().frames());
  if (tell) tell_books(setup, workload_, unseen, workload_.frames().frames());
  for (size_t i = 0; i < cases_.size(); ++i) {
    results_[i].frames_without_surface = unseen;
    results_[i].memory_bytes = {{"lists", algorithms_[i]->upload_bytes()},
                                {"lights", frame_.light_bytes()},
                                {"targets", frame_.target_bytes()}};
    if (frame_.shadow_maps()) results_[i].memory_bytes["shadow_maps"] = frame_.shadow_map_bytes();
  }
}

void SetupRun::timed_lap(uint32_t lap, const Step& done) {
  const bool measured = lap >= config_.measure.warmup;
  const uint32_t repeat = measured ? lap - config_.measure.warmup : 0;
  const gpu::Timing timing =
      config_.measure.mode == TimingMode::stages ? gpu::Timing::stages : gpu::Timing::whole;
  const auto count = static_cast<uint32_t>(cases_.size());
  for (uint32_t index = 0; index < workload_.frames().frames(); ++index) {
    load_again(index);
    for (uint32_t i : interleaved_order(count, config_.measure.seed, lap, index)) {
      stop_if_interrupted();
      ShadedAlgorithm& algorithm = *algorithms_[i];
      spans_.clear();
      auto begin = Clock::now();
      algorithm.prepare(*input_, spans_, frame_.occupied_blocks().positions());
      auto prepared = Clock::now();
      gpu::SubmissionTimes times = algorithm.shade(frame_, *input_, timing);
      double prepare_ms = milliseconds_between(begin, prepared),
             shade_ms = milliseconds_between(prepared, Clock::now());
      log_.add("prepare", prepare_ms);
      log_.add("shade", shade_ms);
      done(StepKind::timing, i, (measured ? "timing " : "warming up ") + cases_[i].id);
      if (!measured) continue;

      CaseResult& result = results_[i];
      std::vector<std::pair<std::string, double>> stages;
      for (const std::string& name : algorithm.info().cpu_stages) {
        auto found = spans_.sums().find(name);
        double ms = found == spans_.sums().end() ? 0 : found->second;
        result.cpu_ms.set(name, repeat, index, ms);
        stages.emplace_back(name, ms);
      }
      result.cpu_ms.set("total", repeat, index, prepare_ms);
      for (const auto& [name, ms] : times.spans) result.gpu_ms.set(name, repeat, index, ms);
      result.gpu_ms.set("total", repeat, index, times.whole);
      add_overlap(result.overlap, times, repeat, index);
      if (std::string why = timing_contradiction(times, timing); !why.empty()) {
        ++contradictions_[i];
        if (result.timing_note.empty()) result.timing_note = why;
      }
      std::map<std::string, std::string> arguments{
          {"case", cases_[i].id}, {"frame", std::to_string(index)}, {"repeat", std::to_string(repeat)}};
      log_.trace("cpu", begin, stages, arguments);
      log_.trace(prepared, times.intervals, arguments);
    }
  }
  if (!measured) return;
  // Some samples are hit by the noise of a shared machine; a clock that cannot be believed is wrong in most
  // of them.
  for (size_t i = 0; i < cases_.size(); ++i) {
    uint32_t samples = (repeat + 1) * workload_.frames().frames();
    results_[i].timing_suspect = contradictions_[i] * 4 > samples;
    results_[i].repeats_done = repeat + 1;
    settle_overlap(results_[i].overlap, repeat + 1);
  }
}

void SetupRun::pictures(const std::filesystem::path& folder, const Step& done) {
  std::vector<uint32_t> wanted = config_.outputs.heatmaps;
  wanted.insert(wanted.end(), config_.outputs.images.begin(), config_.outputs.images.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  auto has = [](const std::vector<uint32_t>& list, uint32_t frame) {
    return std::find(list.begin(), list.end(), frame) != list.end();
  };
  for (uint32_t index : wanted) {
    load_again(index);
    auto span = log_.span("pictures");
    std::vector<uint8_t> lit = lit_pixels(frame_);
    for (size_t i = 0; i < cases_.size(); ++i) {
      stop_if_interrupted();
      spans_.clear();
      algorithms_[i]->prepare(*input_, spans_, frame_.occupied_blocks().positions());
      algorithms_[i]->count(frame_, *input_);
      const std::string stem = fmt::format("{}.frame{}", cases_[i].id, index);
      if (has(config_.outputs.images, index)) {
        std::vector<std::string> files = write_image(frame_, folder, "images/" + stem);
        results_[i].images.insert(results_[i].images.end(), files.begin(), files.end());
      }
      if (has(config_.outputs.heatmaps, index)) {
        uint32_t tile =
            results_[i].parameters.contains("tile") ? results_[i].parameters["tile"].get<uint32_t>() : 16;
        std::vector<std::string> files = write_heat_maps(
            {read_counts(frame_), algorithms_[i]->info().counters, algorithms_[i]->own_pixel_counters(frame_),
             lit, frame_.targets().width(), frame_.targets().height(), tile},
            folder, "heatmaps/" + stem);
        results_[i].heatmaps.insert(results_[i].heatmaps.end(), files.begin(), files.end());
      }
      done(StepKind::pictures, i, "pictures of " + cases_[i].id);
    }
  }
}

}  // namespace ml
