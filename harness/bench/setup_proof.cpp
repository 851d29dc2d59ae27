#include "harness/bench/setup_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algorithms/heap_memory.h"
#include "harness/accuracy/image_metrics.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/bench/bookkeeping.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/interruption.h"

namespace ml {
namespace {

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

// The references are known by what they are, not by name.
template <typename Predicate>
const AlgorithmEntry& entry_that(Predicate predicate) {
  for (const AlgorithmEntry& entry : algorithm_registry())
    if (predicate(entry.info)) return entry;
  throw std::logic_error("the registry has no reference algorithm");
}

bool same_for_all_thread_counts(const AlgorithmEntry& entry, const Parameters& parameters,
                                const FrameInput& input, size_t limit) {
  std::optional<std::vector<std::byte>> first;
  for (unsigned count : {1u, 2u, 7u}) {
    Threads threads(count);
    FrameInput copy = input;
    copy.threads = &threads;
    auto algorithm = entry.create(parameters);
    HeapMemory memory(true, limit);
    Spans spans;
    algorithm->prepare(copy, memory, spans);
    if (!first)
      first = memory.all();
    else if (*first != memory.all())
      return false;
  }
  return true;
}

// Seconds that steps are expected to take, on two cores of a software device.
struct ProofSeconds {
  double programs, reference, proof;
};

ProofSeconds proof_seconds(const Setup& setup, const VerifyOptions& options) {
  constexpr double per_test = 9e-9;         // in single precision and in double
  constexpr double per_oracle_test = 5e-9;  // one light, one point
  constexpr double per_pixel = 1e-6;        // pictures and counters of one frame read back and compared
  const double pixels = static_cast<double>(setup.width) * setup.height, lights = setup.lights.count;
  const double tests = std::min(static_cast<double>(options.brute_force_tests), pixels * lights);
  const double reference =
      tests * per_test + options.oracle_points * lights * per_oracle_test + pixels * per_pixel;
  const double proof = 4 * pixels * per_pixel;
  return {0.4 + (reference + proof) / 2, reference, proof};
}

}  // namespace

SetupProof::SetupProof(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
                       const VerifyOptions& options)
    : config_(config),
      setup_(config.setups[cases.front().setup]),
      cases_(cases),
      options_(options),
      device_(device),
      workload_(setup_, config.measure.threads),
      frame_(device, *workload_.scene(), workload_.options(), setup_.width, setup_.height),
      tallies_(cases.size()) {
  const AlgorithmEntry& brute = entry_that([](const AlgorithmInfo& info) { return info.reference_only; });
  if (size_t lights = workload_.lights().base().size();
      brute.info.max_lights && lights > brute.info.max_lights)
    throw UsageError(fmt::format("verify: {} lights, brute force holds {}", lights, brute.info.max_lights));
  Parameters single(brute.parameters);
  brute_ = std::make_unique<ShadedAlgorithm>(device, brute, single, workload_.options());
  if (device.limits().fp64) {
    Parameters twice(brute.parameters);
    twice.set(brute.parameters, "precision", std::string("fp64"), "verify");
    brute64_ = std::make_unique<ShadedAlgorithm>(device, brute, twice, workload_.options());
  }
  const AlgorithmEntry& ideal =
      entry_that([](const AlgorithmInfo& info) { return info.needs_contributing_lists; });
  ideal_ =
      std::make_unique<ShadedAlgorithm>(device, ideal, Parameters(ideal.parameters), workload_.options());
  for (const Case& item : cases_) {
    const AlgorithmSpec& spec = setup_.algorithms[item.algorithm];
    entries_.push_back(&find_algorithm(spec.name, item.id));
    algorithms_.push_back(
        std::make_unique<ShadedAlgorithm>(device, *entries_.back(), spec.parameters, workload_.options()));
    lists_ = std::max(lists_, algorithms_.back()->wanted_lists());
  }
}

void SetupProof::look(const std::vector<uint32_t>& frames) {
  uint32_t unseen = 0;
  for (uint32_t index : frames) {
    stop_if_interrupted();
    frame_.load(workload_.frames().at(index));
    unseen += frame_.occupied_blocks().positions().empty();
  }
  const auto count = static_cast<uint32_t>(frames.size());
  require_surface(setup_, unseen, count);
  if (!options_.quiet) tell_books(setup_, workload_, unseen, count);
}

void SetupProof::plan(const Setup& setup, const VerifyOptions& options, size_t frames, Progress& progress) {
  const ProofSeconds seconds = proof_seconds(setup, options);
  const size_t cases = setup.algorithms.size();
  // The first frame compiles.
  progress.plan(StepKind::programs, seconds.programs, cases + 1);
  progress.plan(StepKind::reference, seconds.reference, frames - 1);
  progress.plan(StepKind::proof, seconds.proof, (frames - 1) * cases);
}

void SetupProof::prove(const std::vector<uint32_t>& frames, Progress& progress) {
  look(frames);
  const ProofSeconds seconds = proof_seconds(setup_, options_);
  for (uint32_t index : frames) {
    stop_if_interrupted();
    const FrameInput& input = workload_.frames().at(index);
    frame_.load(input);
    frame_.find_contributing(input, lists_);
    lit_ = lit_pixels(frame_);
    depths_ = view_depths(frame_, input.view);
    prove_references(input, index);
    const bool first = index == frames.front();
    auto advance = [&](StepKind kind, double expected, const std::string& what) {
      progress.advance(first ? StepKind::programs : kind, first ? seconds.programs : expected, what);
    };
    advance(StepKind::reference, seconds.reference, "references");
    for (size_t i = 0; i < cases_.size(); ++i) {
      stop_if_interrupted();
      prove_case(i, input);
      advance(StepKind::proof, seconds.proof, cases_[i].id);
    }
  }
}

std::vector<size_t> SetupProof::sampled_pixels() const {
  std::vector<size_t> pixels;
  for (const glm::u16vec2 block : blocks_)
    for (uint32_t i = 0; i < 64; ++i) {
      const uint32_t x = block.x * 8 + i % 8, y = block.y * 8 + i / 8;
      if (x < setup_.width && y < setup_.height) pixels.push_back(size_t{y} * setup_.width + x);
    }
  return pixels;
}

void SetupProof::prove_references(const FrameInput& input, uint32_t index) {
  ++frames_;
  ideal_->count(frame_, input);
  ideal_image_ = result_picture(frame_);
  oracle_.emplace(frame_, input);
  judge_.emplace(*oracle_, workload_.options().effects.specular, frame_.contributing().count);
  const uint64_t lights = std::max<uint64_t>(input.lights.count(), 1);
  blocks_ = sampled_blocks(setup_.width, setup_.height,
                           std::max<uint64_t>(options_.brute_force_tests / (64 * lights), 16),
                           hash_u32(config_.measure.seed, index));
  sampled_ = sampled_pixels();
  prove_brute_force(input);
  prove_oracle(index);
}

void SetupProof::prove_brute_force(const FrameInput& input) {
  Spans spans;
  brute_->prepare(input, spans, frame_.occupied_blocks().positions());
  brute_->count_blocks(frame_, input, blocks_);
  brute_image_ = result_picture(frame_);
  const PixelCounts counts = read_counts(frame_);
  const ContributingLights& truth = frame_.contributing();
  reference_pixels_ += sampled_.size();
  for (size_t pixel : sampled_) {
    reference_wrong_ +=
        counts.contributing[pixel] != truth.count[pixel] || counts.hash[pixel] != truth.hash[pixel];
    if (!lit_[pixel]) continue;
    ++reference_lit_;
    reference_short_ += counts.tested[pixel] != input.lights.count();
  }
  if (!brute64_) return;
  brute64_->prepare(input, spans, frame_.occupied_blocks().positions());
  brute64_->count_blocks(frame_, input, blocks_);
  const Picture twice = result_picture(frame_);
  for (size_t pixel : sampled_)
    judge_->against_each_other(brute_image_, twice, pixel, lit_[pixel] != 0, to_double_);
}

void SetupProof::prove_oracle(uint32_t index) {
  std::vector<uint32_t> lit;
  for (uint32_t i = 0; i < lit_.size(); ++i)
    if (lit_[i]) lit.push_back(i);
  if (lit.empty()) return;
  Random random(hash_u32(config_.measure.seed, index, 7));
  for (uint32_t n = 0; n < options_.oracle_points; ++n) {
    const uint32_t pixel = lit[random.below(static_cast<uint32_t>(lit.size()))];
    const OracleAnswer& answer = judge_->answer(pixel);
    const uint32_t count = frame_.contributing().count[pixel];
    const uint32_t apart = std::max(count, answer.contributing) - std::min(count, answer.contributing);
    oracle_marginal_ += apart != 0 && apart <= answer.marginal;
    oracle_wrong_ += apart > answer.marginal;
    judge_->against_truth(ideal_image_, pixel, to_truth_);
  }
}

void SetupProof::prove_case(size_t i, const FrameInput& input) {
  Tally& tally = tallies_[i];
  ShadedAlgorithm& algorithm = *algorithms_[i];
  Spans spans;
  algorithm.prepare(input, spans, frame_.occupied_blocks().positions());
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
  tally.not_finite += compare_images(image, ideal_image_).not_finite;
  for (size_t pixel : sampled_)
    judge_->against_each_other(image, brute_image_, pixel, lit_[pixel] != 0, tally.to_brute);
  for (size_t pixel = 0; pixel < lit_.size(); ++pixel)
    judge_->against_each_other(image, ideal_image_, pixel, lit_[pixel] != 0, tally.to_ideal);
  if (tally.miscounted.empty())
    tally.miscounted = miscounted(entries_[i]->info, counts, frame_.contributing(), lit_,
                                  input.lights.count(), algorithm.wanted_lists());
  if (tally.miscounted.empty())
    tally.miscounted = mislisted(counts, depths_, [&](glm::uvec2 pixel, float depth) {
      return algorithm.lights_listed(pixel, depth);
    });

  // The second time, and the timed program instead of the counting one.
  algorithm.prepare(input, spans, frame_.occupied_blocks().positions());
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

}  // namespace ml
