#include "tests/hard_cases/pruned_check.h"

#include <algorithm>
#include <numeric>

#include "harness/accuracy/image_metrics.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/verify.h"

namespace ml::test {
namespace {

const AlgorithmEntry& entry() {
  return find_algorithm("fine_pruned", "test");
}

}  // namespace

PrunedCheck::PrunedCheck(const Scene& scene, uint32_t width, uint32_t height, const FrameOptions& options)
    : frame_(device(), scene, options, width, height),
      brute_(device(), find_algorithm("brute_force", "test"),
             Parameters(find_algorithm("brute_force", "test").parameters), options) {
  input_.threads = &threads_;
}

void PrunedCheck::load(const Camera& camera, const std::vector<Light>& lights) {
  storage_.fill(lights, camera.position);
  const FrameTargets& targets = frame_.targets();
  input_.view = view_data(camera, targets.width(), targets.height(), static_cast<uint32_t>(lights.size()));
  input_.lights = storage_.lights();
  frame_.load(input_);
  truth_ = frame_.find_contributing(input_, LightLists::none);
  lit_ = lit_pixels(frame_);
  Spans spans;
  brute_.prepare(input_, spans, frame_.occupied_blocks().positions());
  brute_.count(frame_, input_);
  reference_ = result_picture(frame_);
}

ShadedAlgorithm& PrunedCheck::algorithm(const PrunedSettings& settings) {
  std::unique_ptr<ShadedAlgorithm>& made = algorithms_[settings.text()];
  if (!made) {
    Parameters parameters(entry().parameters);
    parameters.set(entry().parameters, "caps", settings.caps, "test");
    parameters.set(entry().parameters, "prune", settings.prune, "test");
    parameters.set(entry().parameters, "walk", settings.walk, "test");
    parameters.set(entry().parameters, "bounds", settings.bounds, "test");
    parameters.set(entry().parameters, "tile_depths", settings.tile_depths, "test");
    parameters.set(entry().parameters, "region_lights", int64_t{settings.region_lights}, "test");
    made = std::make_unique<ShadedAlgorithm>(device(), entry(), parameters, frame_.options());
  }
  return *made;
}

PrunedRun PrunedCheck::run(const PrunedSettings& settings) {
  ShadedAlgorithm& pruned = algorithm(settings);
  Spans spans;
  pruned.prepare(input_, spans, frame_.occupied_blocks().positions());
  pruned.count(frame_, input_);
  PrunedRun run;
  run.counts = read_counts(frame_);
  run.image = result_picture(frame_);
  run.frame = summarize(run.counts, truth_, lit_, pruned.counters());
  return run;
}

std::vector<PrunedSettings> PrunedCheck::lossless() {
  return {{"exact", "fine", "subgroup"}, {"exact", "coarse", "pixel"}, {"exact", "facing", "subgroup"}};
}

void PrunedCheck::expect_lossless(const std::vector<PrunedSettings>& settings) {
  const double mean = std::accumulate(reference_.data.begin(), reference_.data.end(), 0.0) /
                      static_cast<double>(reference_.data.size());
  for (const PrunedSettings& each : settings) {
    SCOPED_TRACE(each.text());
    const PrunedRun first = run(each);
    EXPECT_EQ(first.frame.lost, 0u);
    EXPECT_EQ(first.frame.mismatched_pixels, 0u);
    EXPECT_EQ(first.frame.prepare.overflow_tiles, 0u);
    EXPECT_EQ(first.frame.prepare.overflow_lights, 0u);
    EXPECT_LE(first.frame.prepare.fine_lights, first.frame.prepare.coarse_lights);
    for (size_t i = 0; i < lit_.size(); ++i)
      ASSERT_LE(first.counts.listed[i], input_.lights.count()) << "pixel " << i;
    const ImageDifference difference =
        compare_images(first.image, reference_, std::max(image_floor * mean, 1e-30));
    EXPECT_LE(difference.max_relative, image_tolerance)
        << "at " << difference.worst_x << ", " << difference.worst_y;
    EXPECT_EQ(difference.not_finite, 0u);

    algorithm(each).shade(frame_, input_, gpu::Timing::none);
    EXPECT_EQ(compare_images(result_picture(frame_), first.image).differing_bits, 0u)
        << "timed and counting program differ";
    const PrunedRun second = run(each);
    EXPECT_TRUE(first.counts.listed == second.counts.listed && first.counts.hash == second.counts.hash)
        << "counters differ the second time";
    EXPECT_EQ(compare_images(second.image, first.image).differing_bits, 0u) << "the second time";
  }
}

uint64_t PrunedCheck::contributing() const {
  return std::accumulate(truth_.count.begin(), truth_.count.end(), uint64_t{0});
}

uint32_t PrunedCheck::tiles() const {
  return ((frame_.targets().width() + 15) / 16) * ((frame_.targets().height() + 15) / 16);
}

uint32_t PrunedCheck::tile_of(size_t pixel) const {
  const size_t width = frame_.targets().width(), columns = (width + 15) / 16;
  return static_cast<uint32_t>(pixel / width / 16 * columns + pixel % width / 16);
}

}  // namespace ml::test
