// What a setup's proof says in the end.
#include <fmt/format.h>

#include "harness/bench/setup_proof.h"

namespace ml {

std::vector<Claim> SetupProof::claims() const {
  std::vector<Claim> list;
  add_reference_claims(list);
  for (size_t i = 0; i < cases_.size(); ++i) add_case_claims(i, list);
  return list;
}

void SetupProof::add_reference_claims(std::vector<Claim>& list) const {
  const std::string reference = fmt::format("{}, {} lights, {}x{}", setup_.scene_label,
                                            workload_.lights().base().size(), setup_.width, setup_.height);
  list.push_back({reference, "the reference looked at every light",
                  reference_short_ == 0 && reference_lit_ > 0,
                  fmt::format("{} of {} pixels", reference_lit_ - reference_short_, reference_lit_)});
  list.push_back({reference, "the reference lists are brute force's",
                  reference_wrong_ == 0 && reference_pixels_ > 0,
                  fmt::format("{} of {} sampled pixels differ, {} frames", reference_wrong_,
                              reference_pixels_, frames_)});
  list.push_back({reference, "the reference lists are the double-precision oracle's", to_truth_.wrong == 0,
                  fmt::format("{} of {} points differ, {} more within rounding of a light's edge",
                              to_truth_.wrong, to_truth_.radiance.pixels, to_truth_.marginal)});
  list.push_back({reference, "radiance is the double-precision oracle's within rounding",
                  to_truth_.radiance.holds(), to_truth_.radiance.evidence("points")});
  if (brute64_)
    list.push_back({reference, "brute force in single precision is its double within rounding",
                    to_double_.holds(), to_double_.evidence("pixels")});
}

void SetupProof::add_case_claims(size_t i, std::vector<Claim>& list) const {
  const Tally& t = tallies_[i];
  const std::string& id = cases_[i].id;
  list.push_back({id, "its counters agree with each other", t.miscounted.empty(),
                  t.miscounted.empty() ? fmt::format("{} pixels", t.pixels) : t.miscounted});
  if (t.overflow_lights > 0) {
    // Caps that the user asked for, and a demand beyond them: there is no more to claim than that it is
    // told.
    list.push_back({id, "nothing but what its caps cut off is lost", t.mismatched <= t.lost,
                    fmt::format("lost {}, {} of {} pixels differ; {} lights over the caps in {} tiles",
                                t.lost, t.mismatched, t.pixels, t.overflow_lights, t.overflow_tiles)});
  } else if (entries_[i]->info.exact) {
    list.push_back({id, "no light lost, none twice", t.lost == 0 && t.mismatched == 0,
                    fmt::format("lost {}, {} of {} pixels differ, {} lights, {} frames{}", t.lost,
                                t.mismatched, t.pixels, t.lights, frames_, t.mismatch)});
    list.push_back({id, "image is brute force's within rounding", t.to_brute.holds(),
                    t.to_brute.evidence("sampled pixels")});
    list.push_back(
        {id, "image is ideal's within rounding", t.to_ideal.holds(), t.to_ideal.evidence("pixels")});
  }
  list.push_back({id, "every pixel is finite", t.not_finite == 0,
                  fmt::format("{} of {} are not", t.not_finite, t.pixels)});
  list.push_back({id, "same inputs, same bits", t.unlike.empty(),
                  fmt::format("counters and images of two runs, uploads of 1, 2 and 7 threads: {}",
                              t.unlike.empty() ? "identical" : "not the same: " + t.unlike)});
}

}  // namespace ml
