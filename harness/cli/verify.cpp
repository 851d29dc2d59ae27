#include "harness/bench/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "harness/cli/commands.h"

namespace ml {
namespace {

struct Arguments {
  std::string config;
  std::vector<std::string> overrides;
  VerifyOptions options;
};

ExitCode verify(const Arguments& arguments) {
  // It makes no pictures: those that the configuration asks for need not be of frames that are there when
  // somebody looks at fewer.
  std::vector<std::string> overrides{"outputs.heatmaps=[]", "outputs.images=[]"};
  overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
  Config config = load_config(arguments.config, overrides);
  std::string subject;
  std::vector<Claim> claims = verify_config(config, arguments.options, [&](const Claim& claim) {
    if (claim.subject != subject) fmt::print("{}\n", subject = claim.subject);
    fmt::print("  {}  {}: {}\n", claim.holds ? "proven" : "FAILED", claim.text, claim.evidence);
    std::fflush(stdout);  // what is proven is told, also when the rest is interrupted
  });
  auto failed = std::count_if(claims.begin(), claims.end(), [](const Claim& claim) { return !claim.holds; });
  fmt::print("{} claims proven, {} failed\n", claims.size() - static_cast<size_t>(failed), failed);
  return failed ? ExitCode::claim_failed : ExitCode::done;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("verify", "Prove the claims of a configuration; exit code 1 if one fails");
  command->footer(
      "Proves first that the reference looked at every light. Then for every case: no light lost and none\n"
      "evaluated twice, on every pixel; the image is brute force's and ideal's within what rounding makes at "
      "each\n"
      "point; nothing is NaN or infinite; two runs and 1, 2 and 7 threads give the same bits. And for the\n"
      "reference: its lists of contributing lights are brute force's and a double-precision oracle's.\n"
      "Example: manylights verify quick --set lights.count=65536 --frames 2");
  command->add_option("CONFIG", arguments->config, "Configuration")->required();
  command->add_option("--set", arguments->overrides, "Override KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--frames", arguments->options.frames, "Frames per setup, spread over the path; 0: all")
      ->capture_default_str();
  command
      ->add_option("--brute-force", arguments->options.brute_force_tests,
                   "Light evaluations of sampled brute force per frame")
      ->capture_default_str();
  command
      ->add_option("--oracle-points", arguments->options.oracle_points,
                   "Surface points per frame for the oracle")
      ->capture_default_str();
  command->add_option("--device", arguments->options.device,
                      "Vulkan device: part of its name, index or UUID");
  command->add_flag("--validation", arguments->options.validation,
                    "Run with the validation layer; a message is a failed claim");
  command->add_flag("--quiet", arguments->options.quiet, "No progress");
  command->callback([arguments, &action] { action = [arguments] { return verify(*arguments); }; });
}

}  // namespace ml
