#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "harness/bench/estimate.h"
#include "harness/bench/runner.h"
#include "harness/cli/commands.h"

namespace ml {
namespace {

struct Arguments {
  std::vector<std::string> configs, overrides;
  std::string out, shard;
  RunOptions options;
  bool dry_run = false;
};

// "2/8": the second of eight shares.
void parse_shard(const std::string& text, RunOptions& options) {
  if (text.empty()) return;
  unsigned index = 0, count = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%u/%u%c", &index, &count, &rest) != 2 || index < 1 || index > count ||
      count > 10000)
    throw UsageError("--shard '" + text + "': expected I/N with 1 <= I <= N, such as 2/8");
  options.shard = index - 1;
  options.shards = count;
}

// Letters that a line of standard output may have; 0 where nobody says, as in a pipe or a file.
size_t output_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

// A folder for the result of each configuration.
std::vector<std::filesystem::path> output_folders(const Arguments& arguments,
                                                  const std::vector<Config>& configs) {
  std::vector<std::filesystem::path> folders;
  for (const Config& config : configs) {
    std::filesystem::path folder = arguments.out.empty() ? "out" : arguments.out;
    if (arguments.out.empty() || configs.size() > 1) folder /= config.name;
    if (std::find(folders.begin(), folders.end(), folder) != folders.end())
      throw UsageError("two of the configurations are named '" + config.name +
                       "', and would write into one folder: " + folder.string());
    folders.push_back(std::move(folder));
  }
  return folders;
}

ExitCode run(const Arguments& arguments) {
  RunOptions options = arguments.options;
  parse_shard(arguments.shard, options);
  // All configurations are read before any work starts.
  std::vector<Config> configs;
  for (const std::string& name : arguments.configs) configs.push_back(load_config(name, arguments.overrides));
  const std::vector<std::filesystem::path> folders = output_folders(arguments, configs);
  for (size_t i = 0; i < configs.size(); ++i) {
    options.out = folders[i];
    if (!arguments.dry_run) check_output(options);
  }
  ExitCode code = ExitCode::done;
  for (size_t i = 0; i < configs.size(); ++i) {
    const Config& config = configs[i];
    options.out = folders[i];
    if (arguments.dry_run) {
      const std::vector<Case> cases = selected_cases(config, options);
      check_inputs(config, cases);
      fmt::print("{}", describe_cases(config, cases));
      continue;
    }
    Result result = run_config(config, options);
    fmt::print("{}\n", summary_table(result, output_width()));
    fmt::print("overhead: {:.1f} % of {:.1f} s are outside timed laps; peak memory {:.0f} MB\n",
               100 * result.harness["outside_timed_laps_fraction"].get<double>(),
               result.harness["wall_ms"].get<double>() / 1000,
               result.harness["peak_memory_bytes"].get<double>() / 1e6);
    fmt::print("result: {}\n", (options.out / "result.json").string());
    for (const CaseResult& one : result.cases)
      if (one.invalid) code = ExitCode::claim_failed;
  }
  return code;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "run", "Measure the cases of configurations and write result.json, heat maps and pictures");
  command->footer(
      "CONFIG is a file or the name of a shipped configuration (manylights list configs).\n"
      "Examples\n"
      "  manylights run quick --out out/quick\n"
      "  manylights run quick --set lights.count=65536 --set resolution=[1920,1080]\n"
      "  manylights run quick --set 'sweep={\"algorithms.tile\":[16,24,32]}' --filter clustered\n"
      "  manylights run big.json --resume           go on after an interruption\n"
      "  manylights run big.json --shard 2/8        the second of eight shares, for a cluster");
  command->add_option("CONFIG", arguments->configs, "Configurations")->required();
  command->add_option("--out", arguments->out,
                      "Folder of the result (default: out/NAME; with several configurations OUT/NAME)");
  command
      ->add_option("--set", arguments->overrides,
                   "Override KEY=VALUE, the value as JSON; may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--filter", arguments->options.filter,
                      "Only cases whose id this regular expression matches");
  command->add_option("--device", arguments->options.device,
                      "Vulkan device: part of its name, index or UUID");
  command->add_option("--shard", arguments->shard, "I/N: only the I-th of N shares of the setups");
  auto* resume = command->add_flag("--resume", arguments->options.resume,
                                   "Keep the complete cases of the result that is already there");
  command->add_flag("--force", arguments->options.force, "Replace the result that is already there")
      ->excludes(resume);
  command->add_flag("--dry-run", arguments->dry_run,
                    "Only load what the cases need and list them, with an estimate of time and memory");
  command->add_flag("--validation", arguments->options.validation,
                    "Run with the validation layer (times are then worthless)");
  command->add_flag("--quiet", arguments->options.quiet,
                    "No progress; what is said of the level is in the result");
  command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace ml
