#include "harness/bench/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "harness/accuracy/image_metrics.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/interruption.h"
#include "harness/bench/oracle_input.h"
#include "harness/bench/progress.h"
#include "harness/bench/workload.h"

namespace ml {
namespace {

// The frame numbers to look at: first, last and evenly between.
std::vector<uint32_t> chosen_frames(uint32_t frames, uint32_t wanted) {
  std::vector<uint32_t> list;
  if (wanted == 0 || wanted >= frames)
    for (uint32_t i = 0; i < frames; ++i) list.push_back(i);
  else
    for (uint32_t i = 0; i < wanted; ++i) list.push_back(wanted == 1 ? 0 : i * (frames - 1) / (wanted - 1));
  return list;
}

// Different 8x8 blocks of the picture, seeded, in ascending order.
std::vector<glm::u16vec2> sampled_blocks(uint32_t width, uint32_t height, uint64_t count, uint32_t seed) {
  uint32_t across = (width + 7) / 8, down = (height + 7) / 8, all = across * down;
  std::vector<uint32_t> order(all);
  for (uint32_t i = 0; i < all; ++i) order[i] = i;
  Random random(seed);
  auto taken = static_cast<uint32_t>(std::min<uint64_t>({count, all, 65535}));
  for (uint32_t i = 0; i < taken; ++i) std::swap(order[i], order[i + random.below(all - i)]);
  order.resize(taken);
  std::sort(order.begin(), order.end());
  std::vector<glm::u16vec2> blocks;
  for (uint32_t block : order) blocks.emplace_back(block % across, block / across);
  return blocks;
}

// The pixels of the blocks as a picture of their own, 64 to a row.
Picture gathered(const Picture& picture, const std::vector<glm::u16vec2>& blocks) {
  Picture result(64, std::max<uint32_t>(1, static_cast<uint32_t>(blocks.size())), picture.channels);
  for (size_t b = 0; b < blocks.size(); ++b)
    for (uint32_t i = 0; i < 64; ++i) {
      uint32_t x = blocks[b].x * 8 + i % 8, y = blocks[b].y * 8 + i / 8;
      if (x >= picture.width || y >= picture.height) continue;
      for (size_t channel = 0; channel < 3; ++channel)
        result.data[result.pixel(i, static_cast<uint32_t>(b)) + channel] =
            picture.data[picture.pixel(x, y) + channel];
    }
  return result;
}

double mean_of(const Picture& picture) {
  double sum = 0;
  for (float value : picture.data) sum += std::isfinite(value) ? static_cast<double>(value) : 0;
  return picture.data.empty() ? 0 : sum / static_cast<double>(picture.data.size());
}

// The references are known by what they are, not by name.
template <typename Predicate>
const AlgorithmEntry& entry_that(Predicate predicate) {
  for (const AlgorithmEntry& entry : algorithm_registry())
    if (predicate(entry.info)) return entry;
  throw std::logic_error("the registry has no reference algorithm");
}

// Sums over the frames of a setup, turned into claims at the end.
struct Tally {
  uint64_t lost = 0, overflow_lights = 0, overflow_tiles = 0, mismatched = 0, pixels = 0, lights = 0,
           not_finite = 0, differing = 0;
  double worst = 0, worst_ideal = 0;
  bool same_bytes = true;
  uint64_t sampled = 0;
};

// Upload memory on the heap, for comparing what different numbers of threads write.
class HeapMemory final : public UploadMemory {
 public:
  explicit HeapMemory(size_t limit) : limit_(limit) {}
  std::span<std::byte> map(uint32_t slot, size_t bytes) override {
    if (slots_.size() <= slot) slots_.resize(slot + 1);
    slots_[slot].assign(bytes, std::byte{0});
    return slots_[slot];
  }
  size_t limit() const override { return limit_; }
  const std::vector<std::vector<std::byte>>& slots() const { return slots_; }

 private:
  size_t limit_;
  std::vector<std::vector<std::byte>> slots_;
};

bool same_for_all_thread_counts(const AlgorithmEntry& entry, const Parameters& parameters,
                                const FrameInput& input, size_t limit) {
  std::optional<std::vector<std::vector<std::byte>>> first;
  for (unsigned count : {1u, 2u, 7u}) {
    Threads threads(count);
    FrameInput copy = input;
    copy.threads = &threads;
    auto algorithm = entry.create(parameters);
    HeapMemory memory(limit);
    Spans spans;
    algorithm->prepare(copy, memory, spans);
    if (!first)
      first = memory.slots();
    else if (*first != memory.slots())
      return false;
  }
  return true;
}

class SetupProof {
 public:
  SetupProof(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
             const VerifyOptions& options)
      : config_(config),
        setup_(config.setups[cases.front().setup]),
        cases_(cases),
        options_(options),
        device_(device),
        workload_(setup_, config.measure.threads),
        frame_(device, *workload_.scene(), workload_.effects(), setup_.width, setup_.height),
        tallies_(cases.size()) {
    const AlgorithmEntry& brute = entry_that([](const AlgorithmInfo& info) { return info.reference_only; });
    if (size_t lights = workload_.lights().base().size();
        brute.info.max_lights && lights > brute.info.max_lights)
      throw UsageError(fmt::format("verify: {} lights, brute force holds {}", lights, brute.info.max_lights));
    Parameters single(brute.parameters);
    brute_ = std::make_unique<ShadedAlgorithm>(device, brute, single, workload_.effects());
    if (device.limits().fp64) {
      Parameters twice(brute.parameters);
      twice.set(brute.parameters, "precision", std::string("fp64"), "verify");
      brute64_ = std::make_unique<ShadedAlgorithm>(device, brute, twice, workload_.effects());
    }
    const AlgorithmEntry& ideal =
        entry_that([](const AlgorithmInfo& info) { return info.needs_contributing_lists; });
    ideal_ =
        std::make_unique<ShadedAlgorithm>(device, ideal, Parameters(ideal.parameters), workload_.effects());
    for (const Case& item : cases_) {
      const AlgorithmSpec& spec = setup_.algorithms[item.algorithm];
      entries_.push_back(&find_algorithm(spec.name, item.id));
      algorithms_.push_back(
          std::make_unique<ShadedAlgorithm>(device, *entries_.back(), spec.parameters, workload_.effects()));
    }
  }

  void prove(Progress& progress) {
    for (uint32_t index : chosen_frames(setup_.camera.frames, options_.frames)) {
      stop_if_interrupted();
      const FrameInput& input = workload_.frames().at(index);
      frame_.load(input);
      frame_.find_contributing(input, true);
      lit_ = lit_pixels(frame_);
      prove_references(input, index);
      progress.advance(1, "references");
      for (size_t i = 0; i < cases_.size(); ++i) {
        stop_if_interrupted();
        prove_case(i, input);
        progress.advance(1, cases_[i].id);
      }
    }
  }

  std::vector<Claim> claims() const;

 private:
  void prove_references(const FrameInput& input, uint32_t index);
  void prove_oracle(const FrameInput& input, uint32_t index);
  void prove_case(size_t i, const FrameInput& input);

  const Config& config_;
  const Setup& setup_;
  std::vector<Case> cases_;
  const VerifyOptions& options_;
  gpu::Device& device_;
  Workload workload_;
  DeviceFrame frame_;
  std::vector<const AlgorithmEntry*> entries_;
  std::unique_ptr<ShadedAlgorithm> brute_, brute64_, ideal_;
  std::vector<std::unique_ptr<ShadedAlgorithm>> algorithms_;
  std::vector<Tally> tallies_;
  std::vector<uint8_t> lit_;
  // Of the frame at hand.
  std::vector<glm::u16vec2> blocks_;
  Picture brute_image_, ideal_image_;
  double floor_ = 0;
  // Over all frames.
  uint64_t reference_pixels_ = 0, reference_wrong_ = 0, oracle_points_ = 0, oracle_wrong_ = 0,
           oracle_marginal_ = 0;
  double oracle_worst_ = 0, fp64_worst_ = 0;
  uint32_t frames_ = 0;
};

void SetupProof::prove_references(const FrameInput& input, uint32_t index) {
  ++frames_;
  Spans spans;
  ideal_->count(frame_, input);
  ideal_image_ = result_picture(frame_);
  floor_ = std::max(image_floor * mean_of(ideal_image_), 1e-30);

  uint64_t lights = std::max<uint64_t>(input.lights.count(), 1);
  blocks_ = sampled_blocks(setup_.width, setup_.height,
                           std::max<uint64_t>(options_.brute_force_tests / (64 * lights), 16),
                           hash_u32(config_.measure.seed, index));
  brute_->prepare(input, spans, frame_.seen_blocks().places());
  brute_->count_blocks(frame_, input, blocks_);
  brute_image_ = gathered(result_picture(frame_), blocks_);
  PixelCounts counts = read_counts(frame_);
  for (const glm::u16vec2 block : blocks_)
    for (uint32_t i = 0; i < 64; ++i) {
      uint32_t x = block.x * 8 + i % 8, y = block.y * 8 + i / 8;
      if (x >= setup_.width || y >= setup_.height) continue;
      size_t pixel = size_t{y} * setup_.width + x;
      ++reference_pixels_;
      reference_wrong_ += counts.contributing[pixel] != frame_.contributing().count[pixel] ||
                          counts.hash[pixel] != frame_.contributing().hash[pixel];
    }
  if (brute64_) {
    brute64_->prepare(input, spans, frame_.seen_blocks().places());
    brute64_->count_blocks(frame_, input, blocks_);
    ImageDifference difference =
        compare_images(brute_image_, gathered(result_picture(frame_), blocks_), floor_);
    fp64_worst_ = std::max(fp64_worst_, difference.max_relative);
  }
  prove_oracle(input, index);
}

void SetupProof::prove_oracle(const FrameInput& input, uint32_t index) {
  OracleFrame oracle(frame_, input);
  std::vector<uint32_t> lit;
  for (uint32_t i = 0; i < lit_.size(); ++i)
    if (lit_[i]) lit.push_back(i);
  if (lit.empty()) return;
  Random random(hash_u32(config_.measure.seed, index, 7));
  for (uint32_t n = 0; n < options_.oracle_points; ++n) {
    uint32_t pixel = lit[random.below(static_cast<uint32_t>(lit.size()))];
    OracleAnswer answer = oracle_shade(oracle.point(pixel), oracle.lights(), workload_.effects().specular);
    uint32_t count = frame_.contributing().count[pixel];
    uint32_t apart = std::max(count, answer.contributing) - std::min(count, answer.contributing);
    ++oracle_points_;
    oracle_marginal_ += apart != 0 && apart <= answer.marginal;
    oracle_wrong_ += apart > answer.marginal;
    for (size_t channel = 0; channel < 3; ++channel) {
      double truth = answer.radiance[static_cast<int>(channel)];
      double value = static_cast<double>(ideal_image_.data[3 * size_t{pixel} + channel]);
      oracle_worst_ = std::max(oracle_worst_, std::abs(value - truth) / std::max(std::abs(truth), floor_));
    }
  }
}

void SetupProof::prove_case(size_t i, const FrameInput& input) {
  Tally& tally = tallies_[i];
  ShadedAlgorithm& algorithm = *algorithms_[i];
  Spans spans;
  algorithm.prepare(input, spans, frame_.seen_blocks().places());
  const uint64_t digest = algorithm.upload_digest();
  algorithm.count(frame_, input);
  PixelCounts counts = read_counts(frame_);
  Picture image = result_picture(frame_);
  FrameCounters counters = summarize(counts, frame_.contributing(), lit_, algorithm.counters());
  tally.lost += counters.lost;
  tally.overflow_lights += counters.prepare.overflow_lights;
  tally.overflow_tiles += counters.prepare.overflow_tiles;
  tally.mismatched += counters.mismatched_pixels;
  tally.pixels += lit_.size();
  tally.lights = std::max<uint64_t>(tally.lights, input.lights.count());
  tally.sampled += blocks_.size() * 64;
  ImageDifference to_brute = compare_images(gathered(image, blocks_), brute_image_, floor_);
  ImageDifference to_ideal = compare_images(image, ideal_image_, floor_);
  tally.worst = std::max(tally.worst, to_brute.max_relative);
  tally.worst_ideal = std::max(tally.worst_ideal, to_ideal.max_relative);
  tally.not_finite += to_ideal.not_finite;

  // The second time, and the timed program instead of the counting one.
  algorithm.prepare(input, spans, frame_.seen_blocks().places());
  tally.same_bytes &= digest == algorithm.upload_digest();
  algorithm.count(frame_, input);
  PixelCounts again = read_counts(frame_);
  tally.same_bytes &= counts.listed == again.listed && counts.tested == again.tested &&
                      counts.contributing == again.contributing && counts.nodes == again.nodes &&
                      counts.hash == again.hash;
  tally.differing += compare_images(result_picture(frame_), image).differing_bits;
  algorithm.shade(frame_, input, gpu::Timing::none);
  tally.differing += compare_images(result_picture(frame_), image).differing_bits;
  const Parameters& parameters = setup_.algorithms[cases_[i].algorithm].parameters;
  tally.same_bytes &=
      same_for_all_thread_counts(*entries_[i], parameters, input, device_.limits().storage_buffer_range);
}

std::vector<Claim> SetupProof::claims() const {
  std::string reference = fmt::format("{}, {} lights, {}x{}", setup_.scene_label,
                                      workload_.lights().base().size(), setup_.width, setup_.height);
  std::vector<Claim> list;
  list.push_back({reference, "the reference lists are brute force's",
                  reference_wrong_ == 0 && reference_pixels_ > 0,
                  fmt::format("{} of {} sampled pixels differ, {} frames", reference_wrong_,
                              reference_pixels_, frames_)});
  list.push_back({reference, "the reference lists are the double-precision oracle's", oracle_wrong_ == 0,
                  fmt::format("{} of {} points differ, {} more within rounding of a light's edge",
                              oracle_wrong_, oracle_points_, oracle_marginal_)});
  list.push_back(
      {reference, "radiance is the double-precision oracle's within 1e-3", oracle_worst_ <= 1e-3,
       fmt::format("largest relative error {:.1e} over {} points", oracle_worst_, oracle_points_)});
  if (brute64_)
    list.push_back(
        {reference, "brute force in single precision is its double within 1e-3", fp64_worst_ <= 1e-3,
         fmt::format("largest relative error {:.1e} over {} pixels", fp64_worst_, reference_pixels_)});
  for (size_t i = 0; i < cases_.size(); ++i) {
    const Tally& t = tallies_[i];
    const std::string& id = cases_[i].id;
    if (t.overflow_lights > 0) {
      // Caps that the user asked for, and a demand beyond them: there is no more to claim than that it is
      // told.
      list.push_back({id, "nothing but what its caps cut off is lost", t.mismatched <= t.lost,
                      fmt::format("lost {}, {} of {} pixels differ; {} lights over the caps in {} tiles",
                                  t.lost, t.mismatched, t.pixels, t.overflow_lights, t.overflow_tiles)});
    } else if (entries_[i]->info.exact) {
      list.push_back({id, "no light lost, none twice", t.lost == 0 && t.mismatched == 0,
                      fmt::format("lost {}, {} of {} pixels differ, {} lights, {} frames", t.lost,
                                  t.mismatched, t.pixels, t.lights, frames_)});
      list.push_back(
          {id, fmt::format("image is brute force's within {:.0e}", image_tolerance),
           t.worst <= image_tolerance,
           fmt::format("largest relative error {:.1e} over {} sampled pixels (floor {:.0e} of the mean)",
                       t.worst, t.sampled, image_floor)});
      list.push_back({id, fmt::format("image is ideal's within {:.0e}", image_tolerance),
                      t.worst_ideal <= image_tolerance,
                      fmt::format("largest relative error {:.1e} over {} pixels", t.worst_ideal, t.pixels)});
    }
    list.push_back({id, "every pixel is finite", t.not_finite == 0,
                    fmt::format("{} of {} are not", t.not_finite, t.pixels)});
    list.push_back(
        {id, "same inputs, same bits", t.same_bytes && t.differing == 0,
         fmt::format(
             "counters and images of two runs, uploads of 1, 2 and 7 threads: {}",
             t.same_bytes && t.differing == 0 ? "identical" : fmt::format("{} pixels differ", t.differing))});
  }
  return list;
}

}  // namespace

std::vector<Claim> verify_config(const Config& config, const VerifyOptions& options,
                                 const std::function<void(const Claim&)>& report) {
  std::vector<const Setup*> setups;
  for (const Setup& setup : config.setups) setups.push_back(&setup);
  check_workloads(setups);
  gpu::Device device({options.device, options.validation});
  if (!options.quiet)
    fmt::print("device: {} ({}, {})\n", device.info().name, device.info().type, device.info().driver);
  std::vector<Case> cases = expand_cases(config);
  uint64_t steps = 0;
  for (const Setup& setup : config.setups)
    steps += chosen_frames(setup.camera.frames, options.frames).size() * (setup.algorithms.size() + 1);
  Progress progress("verify " + config.name, steps, options.quiet);
  std::vector<Claim> all;
  for (size_t setup = 0; setup < config.setups.size(); ++setup) {
    std::vector<Case> own;
    for (const Case& item : cases)
      if (item.setup == setup) own.push_back(item);
    SetupProof proof(device, config, own, options);
    proof.prove(progress);
    for (Claim& claim : proof.claims()) {
      report(claim);
      all.push_back(std::move(claim));
    }
  }
  if (options.validation) {
    std::vector<std::string> messages = device.validation_messages();
    Claim claim{"device", "the validation layer has nothing to say", messages.empty(),
                messages.empty() ? "no message" : one_line(messages.front())};
    report(claim);
    all.push_back(claim);
  }
  return all;
}

}  // namespace ml
