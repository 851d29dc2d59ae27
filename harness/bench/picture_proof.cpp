#include "harness/bench/picture_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/accuracy/rounding.h"

namespace ml {
namespace {

// So many wrong pixels are enough to know: the oracle, which looks at every light, is not asked about more.
constexpr uint64_t enough = 16;

glm::dvec3 value_at(const Picture& picture, size_t pixel) {
  return {picture.data[3 * pixel], picture.data[3 * pixel + 1], picture.data[3 * pixel + 2]};
}

bool finite(const glm::dvec3& value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

}  // namespace

std::string PictureProof::evidence(const char* what) const {
  std::string text = fmt::format("largest relative error {:.1e} over {} {}", worst_relative, pixels, what);
  if (judged) text += fmt::format("; {:.2f} of what rounding makes there, at most", worst_ratio);
  if (wrong) text += fmt::format("; {}{} are beyond it", wrong >= enough ? "at least " : "", wrong);
  return text;
}

const OracleAnswer& PictureJudge::answer(size_t pixel) {
  const auto [found, is_new] = answers_.try_emplace(pixel);
  if (is_new) found->second = oracle_shade(frame_.point(pixel), frame_.lights(), specular_);
  return found->second;
}

void PictureJudge::judge(const glm::dvec3& error, const glm::dvec3& allowed, PictureProof& proof) {
  ++proof.judged;
  double ratio = 0;
  for (int channel = 0; channel < 3; ++channel) ratio = std::max(ratio, error[channel] / allowed[channel]);
  proof.worst_ratio = std::max(proof.worst_ratio, ratio);
  proof.wrong += !(ratio <= 1);
}

void PictureJudge::against_truth(const Picture& picture, size_t pixel, PictureProof& proof) {
  ++proof.pixels;
  const glm::dvec3 value = value_at(picture, pixel);
  if (!finite(value)) {
    ++proof.wrong;
    return;
  }
  const OracleAnswer& truth = answer(pixel);
  const glm::dvec3 error = glm::abs(value - truth.radiance);
  for (int channel = 0; channel < 3; ++channel)
    if (error[channel] > 0)
      proof.worst_relative =
          std::max(proof.worst_relative, error[channel] / std::max(truth.radiance[channel], value[channel]));
  judge(error, truth.tolerance, proof);
}

void PictureJudge::against_each_other(const Picture& a, const Picture& b, size_t pixel, bool lit,
                                      PictureProof& proof) {
  ++proof.pixels;
  const glm::dvec3 first = value_at(a, pixel), second = value_at(b, pixel), error = glm::abs(first - second);
  if (error == glm::dvec3(0)) return;
  if (!lit || !finite(first) || !finite(second)) {
    ++proof.wrong;
    return;
  }
  double relative = 0;
  for (int channel = 0; channel < 3; ++channel)
    if (error[channel] > 0)
      relative = std::max(relative, error[channel] / std::max(first[channel], second[channel]));
  proof.worst_relative = std::max(proof.worst_relative, relative);
  if (relative <= plain_rounding + 2 * rounding_unit * contributing_[pixel]) return;
  if (proof.wrong >= enough) return;
  // Each is off by what rounding makes, in either direction.
  judge(error, 2.0 * answer(pixel).tolerance, proof);
}

}  // namespace ml
