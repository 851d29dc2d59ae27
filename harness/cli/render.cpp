#include "harness/bench/render.h"

#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"

namespace ml {
namespace {

struct Arguments {
  std::string config;
  std::vector<std::string> overrides;
  RenderOptions options;
};

ExitCode render(const Arguments& arguments) {
  Config config = load_config(arguments.config, arguments.overrides);
  for (const std::filesystem::path& file : render_frame(config, arguments.options))
    fmt::print("{}\n", file.string());
  return ExitCode::done;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("render", "Render one frame, with what is needed to check its numbers elsewhere");
  command->footer(
      "AOVs are camera-relative (world axes) in metres and are written beside OUT as STEM.NAME.exr; pixels "
      "of the sky are 0 (counts: -1).\n"
      "scripts/check_frame.py recounts the contributing lights from them and the CSV, sharing no code with "
      "this program.\n"
      "Example: manylights render quick --frame 8 --out f.exr --aov all --lights f.csv");
  command->add_option("CONFIG", arguments->config, "Configuration; its first setup is rendered")->required();
  command->add_option("--frame", arguments->options.frame, "Frame number")->required();
  command->add_option("--out", arguments->options.out, "Picture to write, .exr or .png")->required();
  command->add_option("--algorithm", arguments->options.algorithm,
                      "Which of the configuration's algorithms (default: the first)");
  command
      ->add_option(
          "--aov", arguments->options.aovs,
          "position, normal, depth, albedo, material, contributing, listed or all, separated by commas")
      ->delimiter(',');
  command->add_option("--lights", arguments->options.lights, "CSV of the frame's lights");
  command->add_option("--set", arguments->overrides, "Override KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--device", arguments->options.device,
                      "Vulkan device: part of its name, index or UUID");
  command->add_flag("--validation", arguments->options.validation, "Run with the validation layer");
  command->callback([arguments, &action] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace ml
