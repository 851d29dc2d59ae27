#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/config/config.h"
#include "harness/gltf/gltf.h"
#include "scenes/load_scene.h"

namespace ml {
namespace {

struct Arguments {
  std::string name, out;
  std::vector<std::string> overrides;
};

ExitCode write_scene(const Arguments& arguments) {
  // The configuration reader knows every scene and light key and its limits.
  nlohmann::json json{
      {"name", "scene"}, {"scene", arguments.name}, {"algorithms", "all"}, {"outputs", {{"trace", false}}}};
  Config config = parse_config_text(json.dump(), "scene " + arguments.name, "", arguments.overrides);
  const Setup& setup = config.setups.front();
  Scene scene = load_scene(setup.scene);
  LightSet lights(setup.lights, scene);
  export_glb(scene, lights.base(), arguments.out);
  fmt::print("{}: {} triangles, {} lights, {:.0f} x {:.0f} x {:.0f} m\n", arguments.out,
             scene.triangle_count(), lights.base().size(), scene.bounds.size().x, scene.bounds.size().y,
             scene.bounds.size().z);
  return ExitCode::done;
}

}  // namespace

void add_scene(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("scene", "Write a procedural scene with its lights and camera path as GLB");
  command->footer(
      "Lights up to 4096 travel as KHR_lights_punctual, more in a binary file beside the GLB.\n"
      "Example: manylights scene canyon --out canyon.glb --set lights.count=4096");
  command->add_option("NAME", arguments->name, "Scene (manylights list scenes)")->required();
  command->add_option("--out", arguments->out, "File to write, .glb")->required();
  command->add_option("--set", arguments->overrides, "Override KEY=VALUE of scene.* and lights.*")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([arguments, &action] { action = [arguments] { return write_scene(*arguments); }; });
}

}  // namespace ml
