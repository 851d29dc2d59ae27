#include "harness/config/config.h"

#include <algorithm>
#include <optional>

#include "harness/base/error.h"
#include "harness/base/json_text.h"
#include "harness/config/algorithm_list.h"
#include "harness/config/keys.h"
#include "harness/config/sweep.h"
#include "scenes/scene_registry.h"

namespace ml {

namespace {

using nlohmann::json;

std::string name_from(const std::string& source) {
  std::string name = std::filesystem::path(source).stem().string().substr(0, 100);
  for (char& c : name) {
    bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                 c == '_' || c == '-';
    if (!plain) c = '-';
  }
  name.erase(0, name.find_first_not_of(".-"));
  return name.empty() ? "config" : name;
}

bool is_top_key(const std::string& name) {
  if (name == "sweep" || name == "zip") return true;
  auto named = [&](const Key& key) { return key.path == name && key.path.find('.') == key.path.npos; };
  return std::any_of(config_keys().begin(), config_keys().end(), named);
}

// The whole document into a draft and its sweeps.
void read_document(const Node& root, Draft& draft, Sweeps& sweeps) {
  root.object();
  for (const auto& [name, value] : root.json().items()) {
    if (!is_top_key(name)) unknown_key(root, "", name);
  }
  for (const Key& key : config_keys()) {
    if (key.path.find('.') == key.path.npos && root.json().contains(key.path))
      key.read(root.member(key.path), draft);
  }
  if (root.json().contains("sweep")) sweeps.read(root.member("sweep"), false);
  if (root.json().contains("zip")) sweeps.read(root.member("zip"), true);
}

// JSON when it is JSON, else the text itself; what begins like a list, an object or a quoted text must be
// JSON.
json override_value(const std::string& text, const std::string& key) {
  try {
    return parse_json_text(text, "--set " + key);
  } catch (const UsageError&) {
    if (!text.empty() && (text[0] == '{' || text[0] == '[' || text[0] == '"')) throw;
    return text;
  }
}

// Which of the two keys that say which lights there are came from an override.
struct LightOverrides {
  bool placement = false, count = false;

  void see(const std::string& path, const json& value) {
    const bool whole = path == "lights" && value.is_object();
    placement = placement || path == "lights.placement" || (whole && value.contains("placement"));
    count = count || path == "lights.count" || (whole && value.contains("count"));
  }
};

void apply_override(const std::string& text, Draft& draft, Sweeps& sweeps, LightOverrides& lights) {
  static const Source source{"--set", {}};
  size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) throw UsageError("--set: '" + text + "': expected KEY=VALUE");
  std::string path = text.substr(0, equals);
  json value = override_value(text.substr(equals + 1), path);
  Node node(value, source, "$" + json_path_key(path));
  for (bool zipped : {false, true}) {
    const std::string list = zipped ? "zip" : "sweep";
    if (path == list) return sweeps.read(node, zipped);
    if (path.starts_with(list + ".")) return sweeps.read_list(path.substr(list.size() + 1), node, zipped);
  }
  Key key = find_key(path, node);
  if (key.section && path != "scene" && value.is_object()) {
    for (const auto& [name, part] : value.items()) sweeps.forget(path + "." + name, node);
  } else {
    sweeps.forget(path, node);
  }
  key.read(node, draft);
  lights.see(path, value);
}

// What no single key can be blamed for.
void check_setup(const Setup& setup, const OutputSpec& outputs, const Source& source,
                 const PointText& point) {
  static const json nothing;
  auto at = [&] {
    std::string text = point();
    return text.empty() ? "" : " (at " + text + ")";
  };
  auto check_frames = [&](const char* path, const std::vector<uint32_t>& frames) {
    for (size_t i = 0; i < frames.size(); ++i) {
      if (frames[i] < setup.camera.frames) continue;
      Node(nothing, source, std::string(path) + "[" + std::to_string(i) + "]")
          .fail("frame " + std::to_string(frames[i]) + " is not among the " +
                std::to_string(setup.camera.frames) + " frames from 0 on" + at());
    }
  };
  check_frames("$.outputs.heatmaps", outputs.heatmaps);
  check_frames("$.outputs.images", outputs.images);
  if (std::string wrong = shape_shares_error(setup.lights); !wrong.empty())
    Node(nothing, source, "$.lights").fail(wrong + at());
  for (size_t i = 0; i < setup.algorithms.size(); ++i) {
    const AlgorithmSpec& spec = setup.algorithms[i];
    const AlgorithmEntry& entry = find_algorithm(spec.name, source.name + ": $.algorithms");
    uint32_t max_lights = entry.info.max_lights;
    if (max_lights > 0 && setup.lights.placement != Placement::gltf && setup.lights.count > max_lights) {
      Node(nothing, source, "$.lights.count")
          .fail(std::to_string(setup.lights.count) + " lights are more than '" + spec.name +
                "' can take: " + std::to_string(max_lights) + at());
    }
    std::string wrong = entry.check ? entry.check(spec.parameters, setup.width, setup.height) : "";
    if (!wrong.empty())
      Node(nothing, source, "$.algorithms[" + std::to_string(i) + "]").fail(spec.name + ": " + wrong + at());
  }
}

// Names the scene's own placement, radius ratio and script where nothing else is said. The draft, which is
// written as the resolved configuration, leaves them out when they depend on which scene of a sweep it is.
void complete_lights(Draft& draft, std::vector<Setup>& setups) {
  const LightDefaults first = light_defaults(setups.front().scene);
  bool alike = true;
  for (Setup& setup : setups) {
    LightDefaults defaults = light_defaults(setup.scene);
    setup.lights = completed(setup.lights, defaults);
    alike = alike && defaults == first;
  }
  if (alike) draft.setup.lights = completed(draft.setup.lights, first);
}

Config build_config(const json& document, const std::string& source_name,
                    const std::filesystem::path& relative_to, const std::vector<std::string>& overrides) {
  Source source{source_name, relative_to};
  Draft draft;
  draft.name = name_from(source_name);
  draft.setup.scene.procedural = scene_names().front();
  draft.setup.lights.auto_count = true;
  static const json all = "all";
  draft.setup.algorithms = read_algorithms(Node(all, source, "$.algorithms"));
  Sweeps sweeps;
  read_document(Node(document, source), draft, sweeps);
  LightOverrides lights;
  for (const std::string& text : overrides) apply_override(text, draft, sweeps, lights);
  // A file's count was meant for the placement that the file names, not for the one that takes its place.
  if (lights.placement && !lights.count && draft.setup.lights.placement == Placement::gltf) {
    draft.setup.lights.auto_count = true;
    draft.setup.lights.count = LightSpec().count;
  }
  if (draft.setup.algorithms.empty())
    throw UsageError(source_name + ": $.algorithms: there are no algorithms");

  Config config;
  config.name = draft.name;
  config.measure = draft.measure;
  config.outputs = draft.outputs;
  sweeps.expand(draft, source, [&](const Setup& setup, const PointText& point) {
    check_setup(setup, draft.outputs, source, point);
    config.setups.push_back(setup);
  });
  complete_lights(draft, config.setups);
  config.resolved = json::object();
  for (const Key& key : config_keys()) {
    if (key.path.find('.') == key.path.npos) config.resolved[key.path] = key.write(draft);
  }
  // Where only some points of a sweep take a file's lights, the draft's own placement does not show it.
  if (draft.setup.lights.auto_count &&
      std::any_of(config.setups.begin(), config.setups.end(),
                  [](const Setup& setup) { return setup.lights.placement == Placement::gltf; }))
    config.resolved["lights"]["count"] = "auto";
  sweeps.write(draft, config.resolved);
  return config;
}

}  // namespace

Config parse_config(const json& document, const std::string& source,
                    const std::filesystem::path& relative_to) {
  return build_config(document, source, relative_to, {});
}

Config parse_config_text(std::string_view text, const std::string& source,
                         const std::filesystem::path& relative_to,
                         const std::vector<std::string>& overrides) {
  return build_config(parse_json_text(text, source), source, relative_to, overrides);
}

}  // namespace ml
