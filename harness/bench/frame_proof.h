// The proof of one frame: what every algorithm owes, whoever asks for it: `verify`, the hard cases, an
// algorithm's own test.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/counting.h"
#include "harness/bench/oracle_input.h"
#include "harness/bench/picture_proof.h"
#include "harness/output/picture.h"

namespace ml {

// A frame on the device and what is true of it.
class FrameTruth {
 public:
  // Loads the frame and finds the contributing lights, with lists for those that walk `lists`.
  FrameTruth(DeviceFrame& frame, const FrameInput& input, LightLists lists);

  DeviceFrame& frame() const { return frame_; }
  const FrameInput& input() const { return input_; }
  const ContributingLights& contributing() const { return frame_.contributing(); }
  const std::vector<uint8_t>& lit() const { return lit_; }  // a flag a pixel, row by row
  const ViewDepths& depths() const { return depths_; }
  // Of the double-precision oracle; reads the g-buffer back the first time.
  PictureJudge& judge();

 private:
  DeviceFrame& frame_;
  const FrameInput& input_;
  std::vector<uint8_t> lit_;
  ViewDepths depths_;
  std::optional<OracleFrame> oracle_;
  std::optional<PictureJudge> judge_;
};

// What a brute-force reference did at some pixels.
struct ReferenceProof {
  Picture picture;
  PixelCounts counts;
  uint64_t lit = 0;         // of the pixels have a surface
  uint64_t cut_short = 0;   // of those at which it did not look at every light
  uint64_t mismatched = 0;  // of the pixels whose contributing lights are not those of the lists
};

// The pixels of `blocks` (8x8 px), or all of them where there are none. The picture is right at these alone.
ReferenceProof prove_reference(ShadedAlgorithm& brute_force, const FrameTruth& truth,
                               const std::vector<glm::u16vec2>& blocks = {});
// The pixels of 8x8 blocks, or all, row by row.
std::vector<size_t> pixels_of(const std::vector<glm::u16vec2>& blocks, uint32_t width, uint32_t height);

// An algorithm: its counters agree with each other, with the lists and with what contributes, and the same
// inputs give the same bits.
struct FrameProof {
  Picture picture;
  PixelCounts counts;
  std::map<std::string, double> own;  // counters of the algorithm's own: all that it declares
  FrameCounters counters;             // `lost`, `mismatched_pixels` and what prepare() had to cut off
  std::string mismatch;     // "pixel (31, 17)", the first whose lights are wrong; empty when none are
  std::string miscounted;   // why the counters cannot be right; empty when they may be
  uint64_t not_finite = 0;  // pixels
  // What was not the same again: uploads of 1, 2 and 7 threads, counters, pictures of the counting program
  // and of the timed one. Empty when all was.
  std::string unlike;
};

FrameProof prove_frame(ShadedAlgorithm& algorithm, const FrameTruth& truth);

// Points that the oracle answers, summed over frames.
struct PointProof {
  uint64_t wrong = 0;     // points at which other lights contribute
  uint64_t marginal = 0;  // points with other lights, all of them within rounding of their edge
  PictureProof radiance;
};

// `pixel` has a surface; `picture` shows all contributing lights.
void prove_point(FrameTruth& truth, const Picture& picture, size_t pixel, PointProof& proof);

}  // namespace ml
