#include "harness/bench/setup_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algorithms/heap_memory.h"
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

// Made anew each time: what is kept from the call before shows nothing of how it is built.
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
      storage_buffer_range_(device.limits().storage_buffer_range),
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
    FrameTruth truth(frame_, workload_.frames().at(index), lists_);
    prove_references(truth, index);
    const bool first = index == frames.front();
    auto advance = [&](StepKind kind, double expected, const std::string& what) {
      progress.advance(first ? StepKind::programs : kind, first ? seconds.programs : expected, what);
    };
    advance(StepKind::reference, seconds.reference, "references");
    for (size_t i = 0; i < cases_.size(); ++i) {
      stop_if_interrupted();
      prove_case(i, truth);
      advance(StepKind::proof, seconds.proof, cases_[i].id);
    }
  }
}

void SetupProof::prove_references(FrameTruth& truth, uint32_t index) {
  ++frames_;
  ideal_->count(frame_, truth.input());
  ideal_image_ = result_picture(frame_);
  const uint64_t lights = std::max<uint64_t>(truth.input().lights.count(), 1);
  const std::vector<glm::u16vec2> blocks = sampled_blocks(
      setup_.width, setup_.height, std::max<uint64_t>(options_.brute_force_tests / (64 * lights), 16),
      hash_u32(config_.measure.seed, index));
  sampled_ = pixels_of(blocks, setup_.width, setup_.height);
  prove_brute_force(truth, blocks);
  prove_oracle(truth, index);
}

void SetupProof::prove_brute_force(FrameTruth& truth, const std::vector<glm::u16vec2>& blocks) {
  ReferenceProof once = prove_reference(*brute_, truth, blocks);
  reference_pixels_ += sampled_.size();
  reference_wrong_ += once.mismatched;
  reference_lit_ += once.lit;
  reference_short_ += once.cut_short;
  brute_image_ = std::move(once.picture);
  if (!brute64_) return;
  const Picture twice = prove_reference(*brute64_, truth, blocks).picture;
  for (size_t pixel : sampled_)
    truth.judge().against_each_other(brute_image_, twice, pixel, truth.lit()[pixel] != 0, to_double_);
}

void SetupProof::prove_oracle(FrameTruth& truth, uint32_t index) {
  std::vector<uint32_t> lit;
  for (uint32_t i = 0; i < truth.lit().size(); ++i)
    if (truth.lit()[i]) lit.push_back(i);
  if (lit.empty()) return;
  Random random(hash_u32(config_.measure.seed, index, 7));
  for (uint32_t n = 0; n < options_.oracle_points; ++n)
    prove_point(truth, ideal_image_, lit[random.below(static_cast<uint32_t>(lit.size()))], to_truth_);
}

void SetupProof::prove_case(size_t i, FrameTruth& truth) {
  const FrameProof proof = prove_frame(*algorithms_[i], truth);
  Tally& tally = tallies_[i];
  tally.lost += proof.counters.lost;
  tally.overflow_lights += proof.counters.prepare.overflow_lights;
  tally.overflow_tiles += proof.counters.prepare.overflow_tiles;
  tally.mismatched += proof.counters.mismatched_pixels;
  tally.pixels += truth.lit().size();
  tally.lights = std::max<uint64_t>(tally.lights, truth.input().lights.count());
  tally.not_finite += proof.not_finite;
  if (tally.miscounted.empty()) tally.miscounted = proof.miscounted;
  if (tally.unlike.empty()) tally.unlike = proof.unlike;
  const Parameters& parameters = setup_.algorithms[cases_[i].algorithm].parameters;
  if (tally.unlike.empty() &&
      !same_for_all_thread_counts(*entries_[i], parameters, truth.input(), storage_buffer_range_))
    tally.unlike = "lists made anew by 1, 2 and 7 threads";
  if (tally.mismatch.empty() && !proof.mismatch.empty())
    tally.mismatch = fmt::format("; first in frame {}, {}", truth.input().index, proof.mismatch);
  auto compare = [&](size_t pixel, const Picture& reference, PictureProof& sums) {
    truth.judge().against_each_other(proof.picture, reference, pixel, truth.lit()[pixel] != 0, sums);
  };
  for (size_t pixel : sampled_) compare(pixel, brute_image_, tally.to_brute);
  for (size_t pixel = 0; pixel < truth.lit().size(); ++pixel) compare(pixel, ideal_image_, tally.to_ideal);
}

}  // namespace ml
