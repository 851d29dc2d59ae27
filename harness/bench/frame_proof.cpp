#include "harness/bench/frame_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "harness/accuracy/image_metrics.h"
#include "harness/bench/case_pictures.h"

namespace ml {
namespace {

bool differ(const PixelCounts& a, const PixelCounts& b) {
  return a.listed != b.listed || a.tested != b.tested || a.contributing != b.contributing ||
         a.nodes != b.nodes || a.hash != b.hash || a.traversal != b.traversal;
}

// Other lights contributed to the pixel than should.
bool mismatched(const PixelCounts& counts, const ContributingLights& truth, size_t pixel) {
  return counts.contributing[pixel] != truth.count[pixel] || counts.hash[pixel] != truth.hash[pixel];
}

}  // namespace

FrameTruth::FrameTruth(DeviceFrame& frame, const FrameInput& input, LightLists lists)
    : frame_(frame), input_(input) {
  frame.load(input);
  frame.find_contributing(input, lists);
  lit_ = lit_pixels(frame);
  depths_ = view_depths(frame, input.view);
}

PictureJudge& FrameTruth::judge() {
  if (!judge_) {
    oracle_.emplace(frame_, input_);
    judge_.emplace(*oracle_, frame_.options().effects.specular, contributing().count);
  }
  return *judge_;
}

std::vector<size_t> pixels_of(const std::vector<glm::u16vec2>& blocks, uint32_t width, uint32_t height) {
  std::vector<size_t> pixels;
  if (blocks.empty()) {
    pixels.resize(size_t{width} * height);
    std::iota(pixels.begin(), pixels.end(), size_t{0});
  }
  for (const glm::u16vec2 block : blocks)
    for (uint32_t i = 0; i < 64; ++i) {
      const uint32_t x = block.x * 8 + i % 8, y = block.y * 8 + i / 8;
      if (x < width && y < height) pixels.push_back(size_t{y} * width + x);
    }
  return pixels;
}

ReferenceProof prove_reference(ShadedAlgorithm& brute_force, const FrameTruth& truth,
                               const std::vector<glm::u16vec2>& blocks) {
  DeviceFrame& frame = truth.frame();
  Spans spans;
  brute_force.prepare(truth.input(), spans, frame.occupied_blocks().positions());
  if (blocks.empty())
    brute_force.count(frame, truth.input());
  else
    brute_force.count_blocks(frame, truth.input(), blocks);
  ReferenceProof proof;
  proof.picture = result_picture(frame);
  proof.counts = read_counts(frame);
  const ContributingLights& lights = truth.contributing();
  for (size_t pixel : pixels_of(blocks, frame.targets().width(), frame.targets().height())) {
    proof.mismatched += mismatched(proof.counts, lights, pixel);
    if (!truth.lit()[pixel]) continue;
    ++proof.lit;
    proof.cut_short += proof.counts.tested[pixel] != truth.input().lights.count();
  }
  return proof;
}

FrameProof prove_frame(ShadedAlgorithm& algorithm, const FrameTruth& truth) {
  DeviceFrame& frame = truth.frame();
  const FrameInput& input = truth.input();
  const std::span<const glm::u16vec2> occupied = frame.occupied_blocks().positions();
  Spans spans;
  algorithm.prepare(input, spans, occupied);
  const uint64_t digest = algorithm.upload_digest();
  algorithm.count(frame, input);
  FrameProof proof;
  proof.picture = result_picture(frame);
  proof.counts = read_counts(frame);
  proof.counters = summarize(proof.counts, truth.contributing(), truth.lit(), algorithm.counters());
  const auto own = [&] {
    return own_counters(algorithm.info(), algorithm.own_counters(), algorithm.own_pixel_counters(frame),
                        truth.lit());
  };
  proof.own = own();
  const ContributingLights& lights = truth.contributing();
  for (size_t i = 0; i < lights.count.size() && proof.mismatch.empty(); ++i)
    if (mismatched(proof.counts, lights, i))
      proof.mismatch =
          fmt::format("pixel ({}, {})", i % input.view.resolution.x, i / input.view.resolution.x);
  proof.not_finite = compare_images(proof.picture, proof.picture).not_finite;
  proof.miscounted = miscounted(algorithm.info(), proof.counts, truth.contributing(), truth.lit(),
                                input.lights.count(), algorithm.wanted_lists());
  if (proof.miscounted.empty())
    proof.miscounted = mislisted(proof.counts, truth.depths(), [&](glm::uvec2 pixel, float depth) {
      return algorithm.lights_listed(pixel, depth);
    });

  auto say = [&](const std::string& what) { proof.unlike += (proof.unlike.empty() ? "" : ", ") + what; };
  auto say_picture = [&](const char* whose) {
    if (const uint64_t bits = compare_images(result_picture(frame), proof.picture).differing_bits)
      say(fmt::format("{} pixels of the {} program", bits, whose));
  };
  algorithm.shade(frame, input, gpu::Timing::none);
  say_picture("timed");
  for (unsigned count : {1u, 2u, 7u}) {
    Threads threads(count);
    FrameInput again = input;
    again.threads = &threads;
    algorithm.prepare(again, spans, occupied);
    if (algorithm.upload_digest() != digest) say(fmt::format("uploads of {} threads", count));
  }
  algorithm.count(frame, input);
  if (differ(read_counts(frame), proof.counts) || own() != proof.own) say("counters");
  say_picture("counting");
  return proof;
}

void prove_point(FrameTruth& truth, const Picture& picture, size_t pixel, PointProof& proof) {
  const OracleAnswer& answer = truth.judge().answer(pixel);
  const uint32_t count = truth.contributing().count[pixel];
  const uint32_t apart = std::max(count, answer.contributing) - std::min(count, answer.contributing);
  proof.marginal += apart != 0 && apart <= answer.marginal;
  proof.wrong += apart > answer.marginal;
  truth.judge().against_truth(picture, pixel, proof.radiance);
}

}  // namespace ml
