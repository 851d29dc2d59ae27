// Pictures that single precision made, compared with the truth and with each other: a difference is an error
// when it is more than rounding can make at that point.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/bench/oracle_input.h"
#include "harness/output/picture.h"

namespace ml {

// Differences of two pictures that are no more than this part of the value, and what adding up in another
// order makes, are rounding wherever they are; the oracle is asked about the others only.
inline constexpr double plain_rounding = 1e-5;

// Sums over pictures.
struct PictureProof {
  uint64_t pixels = 0;
  uint64_t judged = 0;        // of them the oracle was asked about
  uint64_t wrong = 0;         // off by more than rounding can make, or not finite
  double worst_ratio = 0;     // largest error / what rounding can make, of those that were judged
  double worst_relative = 0;  // largest error / value of all

  bool holds() const { return wrong == 0 && pixels > 0; }
  // "largest error 0.31 of what rounding can make, ..."
  std::string evidence(const char* what) const;
};

// Answers of the oracle for the pixels of one frame, kept for all that ask.
class PictureJudge {
 public:
  // `contributing`: lights that contribute, per pixel.
  PictureJudge(const OracleFrame& frame, bool specular, const std::vector<uint32_t>& contributing)
      : frame_(frame), specular_(specular), contributing_(contributing) {}

  const OracleAnswer& answer(size_t pixel);

  // The pixel against the truth; only for lit pixels.
  void against_truth(const Picture& picture, size_t pixel, PictureProof& proof);
  // The pixel of two pictures against each other. Pixels without a surface must be the same.
  void against_each_other(const Picture& a, const Picture& b, size_t pixel, bool lit, PictureProof& proof);

 private:
  void judge(const glm::dvec3& error, const glm::dvec3& allowed, PictureProof& proof);

  const OracleFrame& frame_;
  bool specular_;
  const std::vector<uint32_t>& contributing_;
  std::map<size_t, OracleAnswer> answers_;
};

}  // namespace ml
