#include "harness/bench/verify.h"

#include <fmt/format.h>

#include "harness/base/error.h"
#include "harness/bench/setup_proof.h"

namespace ml {
namespace {

// The frame numbers to look at: first, last and evenly between.
std::vector<uint32_t> chosen_frames(uint32_t frames, uint32_t wanted) {
  std::vector<uint32_t> list;
  if (wanted == 0 || wanted >= frames)
    for (uint32_t i = 0; i < frames; ++i) list.push_back(i);
  else
    for (uint32_t i = 0; i < wanted; ++i) list.push_back(wanted == 1 ? 0 : i * (frames - 1) / (wanted - 1));
  return list;
}

}  // namespace

std::vector<Claim> verify_config(const Config& config, const VerifyOptions& options,
                                 const std::function<void(const Claim&)>& report) {
  std::vector<const Setup*> setups;
  for (const Setup& setup : config.setups) setups.push_back(&setup);
  check_workloads(setups);
  gpu::Device device({options.device, options.validation});
  if (!options.quiet)
    fmt::print("device: {} ({}, {})\n", device.info().name, device.info().type, device.info().driver);
  std::vector<Case> cases = expand_cases(config);
  Progress progress("verify " + config.name, options.quiet);
  for (const Setup& setup : config.setups)
    SetupProof::plan(setup, options, chosen_frames(setup.camera.frames, options.frames).size(), progress);
  std::vector<Claim> all;
  for (size_t setup = 0; setup < config.setups.size(); ++setup) {
    std::vector<Case> own;
    for (const Case& item : cases)
      if (item.setup == setup) own.push_back(item);
    SetupProof proof(device, config, own, options);
    proof.prove(chosen_frames(config.setups[setup].camera.frames, options.frames), progress);
    for (Claim& claim : proof.claims()) {
      report(claim);
      all.push_back(std::move(claim));
    }
  }
  if (options.validation) {
    std::vector<std::string> messages = device.validation_messages();
    Claim claim{"device", "the validation layer has nothing to say", messages.empty(),
                messages.empty() ? "no message" : one_line(messages.front())};
    report(claim);
    all.push_back(claim);
  }
  return all;
}

}  // namespace ml
