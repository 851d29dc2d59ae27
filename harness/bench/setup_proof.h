// The proof of one setup: what `verify` looks at, and the claims that come of it.
#pragma once

#include <memory>
#include <vector>

#include "harness/bench/frame_proof.h"
#include "harness/bench/progress.h"
#include "harness/bench/verify.h"
#include "harness/bench/workload.h"

namespace ml {

class SetupProof {
 public:
  // `cases` belong to one setup. Throws UsageError and SystemError.
  SetupProof(gpu::Device& device, const Config& config, const std::vector<Case>& cases,
             const VerifyOptions& options);

  // What a proof of so many frames adds to the work that is to come.
  static void plan(const Setup& setup, const VerifyOptions& options, size_t frames, Progress& progress);

  // UsageError when none of the frames sees a surface. One step of progress for the references and one for
  // each case of each frame.
  void prove(const std::vector<uint32_t>& frames, Progress& progress);

  // The first is that the reference looked at every light.
  std::vector<Claim> claims() const;

 private:
  // Sums over the frames of a case.
  struct Tally {
    uint64_t lost = 0, overflow_lights = 0, overflow_tiles = 0, mismatched = 0, pixels = 0, lights = 0,
             not_finite = 0;
    PictureProof to_brute, to_ideal;
    // Why the counters contradict themselves, and what was not the same again, of the first frame in which
    // it is so.
    std::string miscounted, unlike;
    std::string mismatch;  // where lights were first wrong
  };

  // Tells what the level brings and what of it is used.
  void look(const std::vector<uint32_t>& frames);
  void prove_references(FrameTruth& truth, uint32_t index);
  void prove_brute_force(FrameTruth& truth, const std::vector<glm::u16vec2>& blocks);
  void prove_oracle(FrameTruth& truth, uint32_t index);
  void prove_case(size_t i, FrameTruth& truth);
  void add_reference_claims(std::vector<Claim>& list) const;
  void add_case_claims(size_t i, std::vector<Claim>& list) const;

  const Config& config_;
  const Setup& setup_;
  std::vector<Case> cases_;
  const VerifyOptions& options_;
  size_t storage_buffer_range_;  // bytes
  Workload workload_;
  DeviceFrame frame_;
  std::vector<const AlgorithmEntry*> entries_;
  std::unique_ptr<ShadedAlgorithm> brute_, brute64_, ideal_;
  std::vector<std::unique_ptr<ShadedAlgorithm>> algorithms_;
  std::vector<Tally> tallies_;
  LightLists lists_ = LightLists::pixels;  // for ideal
  // Of the frame at hand.
  std::vector<size_t> sampled_;  // pixels
  Picture brute_image_, ideal_image_;
  // Over all frames.
  uint64_t reference_pixels_ = 0, reference_lit_ = 0, reference_short_ = 0, reference_wrong_ = 0;
  PointProof to_truth_;
  PictureProof to_double_;
  uint32_t frames_ = 0;
};

}  // namespace ml
