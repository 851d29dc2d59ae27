// The proof of one setup: what `verify` looks at, and the claims that come of it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "harness/bench/counting.h"
#include "harness/bench/picture_proof.h"
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
             not_finite = 0, differing = 0;
    PictureProof to_brute, to_ideal;
    bool same_bytes = true;
    std::string miscounted;  // why the counters contradict themselves, of the first frame in which they do
  };

  // Tells what the level brings and what of it is used.
  void look(const std::vector<uint32_t>& frames);
  void prove_references(const FrameInput& input, uint32_t index);
  void prove_brute_force(const FrameInput& input);
  void prove_oracle(uint32_t index);
  void prove_case(size_t i, const FrameInput& input);
  // The sampled pixels of the frame.
  std::vector<size_t> sampled_pixels() const;
  void add_reference_claims(std::vector<Claim>& list) const;
  void add_case_claims(size_t i, std::vector<Claim>& list) const;

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
  LightLists lists_ = LightLists::pixels;  // for ideal
  // Of the frame at hand.
  std::vector<uint8_t> lit_;
  ViewDepths depths_;
  std::vector<glm::u16vec2> blocks_;
  std::vector<size_t> sampled_;
  Picture brute_image_, ideal_image_;
  std::optional<OracleFrame> oracle_;
  std::optional<PictureJudge> judge_;
  // Over all frames.
  uint64_t reference_pixels_ = 0, reference_lit_ = 0, reference_short_ = 0, reference_wrong_ = 0;
  uint64_t oracle_wrong_ = 0, oracle_marginal_ = 0;
  PictureProof to_truth_, to_double_;
  uint32_t frames_ = 0;
};

}  // namespace ml
