// `verify`: the claims behind every number, proven for a configuration.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/config/config.h"
#include "harness/gpu/device.h"

namespace ml {

// One claim, and how it came out.
struct Claim {
  std::string subject;  // case id, or the setup's reference
  std::string text;     // "no light lost"
  bool holds = false;
  std::string evidence;  // numbers: what was looked at, what was found
};

struct VerifyOptions {
  std::string device;
  bool validation = false;
  uint32_t frames = 3;  // per setup, spread over the path; 0: all
  uint64_t brute_force_tests =
      400'000'000;              // light evaluations that the sampled brute force may cost per frame
  uint32_t oracle_points = 64;  // surface points per frame for the double-precision oracle
  bool quiet = false;
};

// Checks, for each setup on the frames asked for:
//  - that brute force, the reference, tested every light at every sampled pixel: else nothing below means
//  much;
//  - `contributing` (the reference lists) against brute force on sampled 8x8 blocks, count and set, and
//  against the double-precision oracle
//    at sampled points;
//  - brute force in single against double precision, where the device has it;
//  - for each case: counters that agree with each other (miscounted()) and with the lists (mislisted());
//  - for each exact case: lost = 0 and no light twice on every pixel; image equal to brute force on the
//  sampled blocks and to `ideal` on all
//    others; nothing NaN or infinite; the same bytes from 1, 2 and 7 threads; the same image bits and
//    counters on a second run.
// Pictures are equal when they differ by no more than what rounding makes at each point (picture_proof.h).
// `report` is called with each claim as it is settled. Returns all of them.
std::vector<Claim> verify_config(const Config& config, const VerifyOptions& options,
                                 const std::function<void(const Claim&)>& report);

}  // namespace ml
