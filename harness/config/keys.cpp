#include "harness/config/keys.h"

#include <algorithm>
#include <span>
#include <utility>

#include "harness/base/error.h"
#include "harness/config/algorithm_list.h"
#include "harness/config/sections.h"
#include "scenes/load_scene.h"

namespace ml {

namespace {

using nlohmann::json;

template <typename Spec>
const Field<Spec>* find_field(std::span<const Field<Spec>> fields, const std::string& key) {
  auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field<Spec>& field) { return key == field.key; });
  return found == fields.end() ? nullptr : &*found;
}

// The fields that the object has, in the table's order, because some depend on those before.
template <typename Spec>
void read_fields(const Node& node, const char* section, std::span<const Field<Spec>> fields, Spec& spec) {
  node.object();
  for (const auto& [key, value] : node.json().items()) {
    if (!find_field(fields, key)) unknown_key(node, section, key);
  }
  for (const Field<Spec>& field : fields) {
    if (node.json().contains(field.key)) field.read(node.member(field.key), spec);
  }
}

template <typename Spec>
json write_fields(std::span<const Field<Spec>> fields, const Spec& spec) {
  json object = json::object();
  for (const Field<Spec>& field : fields) {
    if (json value = field.write(spec); !value.is_null()) object[field.key] = std::move(value);
  }
  return object;
}

// Adds a section and its keys. `part` finds the section's struct in the draft.
template <typename Spec, typename Part>
void add_section(std::vector<Key>& keys, const char* name, bool sweepable,
                 std::span<const Field<Spec>> fields, Part part) {
  keys.push_back({name, true, sweepable,
                  [=](const Node& node, Draft& draft) { read_fields(node, name, fields, part(draft)); },
                  [=](const Draft& draft) { return write_fields(fields, part(draft)); }});
  for (const Field<Spec>& field : fields) {
    keys.push_back({std::string(name) + "." + field.key, false, sweepable,
                    [&field, part](const Node& node, Draft& draft) { field.read(node, part(draft)); },
                    [&field, part](const Draft& draft) { return field.write(part(draft)); }});
  }
}

void either(const Node& node, const char* a, const char* b) {
  if (!node.json().is_object()) return;
  if (node.json().contains(a) && node.json().contains(b)) {
    node.fail(std::string("'") + a + "' and '" + b + "' exclude each other");
  }
}

void read_scene_key(const Node& node, Draft& draft) {
  if (node.json().is_string()) {
    SceneSpec scene;
    find_field(scene_fields(), "name")->read(node, scene);
    draft.setup.scene = scene;
    return;
  }
  if (!node.json().is_object()) node.expected("the name of a scene, {\"name\": ...} or {\"gltf\": FILE}");
  either(node, "name", "gltf");
  if (!node.json().contains("name") && !node.json().contains("gltf")) {
    for (const auto& [key, value] : node.json().items()) {
      if (!find_field(scene_fields(), key)) unknown_key(node, "scene", key);
    }
    node.fail("the key 'name' or 'gltf' is missing");
  }
  SceneSpec scene;
  read_fields(node, "scene", scene_fields(), scene);
  draft.setup.scene = scene;
}

std::vector<Key> make_keys() {
  std::vector<Key> keys;
  keys.push_back({"name", false, false,
                  [](const Node& node, Draft& draft) {
                    std::string name = node.text(1, 100);
                    auto allowed = [](char c) {
                      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                             c == '.' || c == '_' || c == '-';
                    };
                    if (!std::all_of(name.begin(), name.end(), allowed) || name[0] == '.' || name[0] == '-') {
                      node.expected("letters, digits, '.', '_' and '-', the first a letter, a digit or '_'");
                    }
                    draft.name = name;
                  },
                  [](const Draft& draft) { return json(draft.name); }});
  keys.push_back({"description", false, false,
                  [](const Node& node, Draft& draft) { draft.description = node.text(0, 2000); },
                  [](const Draft& draft) { return json(draft.description); }});

  // `auto&`: the parts are found in a draft to be read into and in one to be written.
  add_section(
      keys, "scene", true, scene_fields(), [](auto& draft) -> auto& { return draft.setup.scene; });
  Key& scene = *std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.path == "scene"; });
  scene.read = read_scene_key;
  add_section(
      keys, "lights", true, light_fields(), [](auto& draft) -> auto& { return draft.setup.lights; });
  add_section(
      keys, "camera", true, camera_fields(), [](auto& draft) -> auto& { return draft.setup.camera; });
  Key& camera = *std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.path == "camera"; });
  camera.read = [read = camera.read](const Node& node, Draft& draft) {
    either(node, "path", "keyframes");
    read(node, draft);
  };
  keys.push_back({"resolution", false, true,
                  [](const Node& node, Draft& draft) { read_resolution(node, draft.setup); },
                  [](const Draft& draft) {
                    return json::array({draft.setup.width, draft.setup.height});
                  }});
  add_section(
      keys, "effects", true, effects_fields(), [](auto& draft) -> auto& { return draft.setup.effects; });
  add_section(
      keys, "shading", true, shading_fields(), [](auto& draft) -> auto& { return draft.setup.shading; });
  keys.push_back({"algorithms", false, true,
                  [](const Node& node, Draft& draft) { draft.setup.algorithms = read_algorithms(node); },
                  [](const Draft& draft) { return write_algorithms(draft.setup.algorithms); }});
  add_section(
      keys, "measure", false, measure_fields(), [](auto& draft) -> auto& { return draft.measure; });
  add_section(
      keys, "outputs", false, output_fields(), [](auto& draft) -> auto& { return draft.outputs; });
  return keys;
}

// "algorithms[2].tile" is "algorithms.2.tile".
std::string without_brackets(const std::string& path) {
  std::string plain;
  for (char c : path) {
    if (c == '[') {
      plain += '.';
    } else if (c != ']') {
      plain += c;
    }
  }
  return plain;
}

}  // namespace

const std::vector<Key>& config_keys() {
  static const std::vector<Key> keys = make_keys();
  return keys;
}

Key find_key(const std::string& path, const Node& node) {
  for (const Key& key : config_keys()) {
    if (key.path == path) return key;
  }
  const std::string prefix = "algorithms";
  if (path.starts_with(prefix + ".") || path.starts_with(prefix + "[")) {
    std::string selector = without_brackets(path.substr(prefix.size())).substr(1);
    return {path, false, true,
            [selector](const Node& value, Draft& draft) {
              set_algorithm_parameter(draft.setup.algorithms, selector, value);
            },
            [selector](const Draft& draft) { return algorithm_parameter(draft.setup.algorithms, selector); }};
  }
  size_t dot = path.find('.');
  std::string head = path.substr(0, dot);
  bool known_section = std::any_of(config_keys().begin(), config_keys().end(),
                                   [&](const Key& key) { return key.section && key.path == head; });
  std::vector<std::string> known;
  if (dot != path.npos && known_section) {
    for (const Key& key : config_keys()) {
      if (key.path.starts_with(head + ".")) known.push_back(key.path.substr(head.size() + 1));
    }
    node.fail("unknown key" + suggestion(path.substr(dot + 1), known));
  }
  for (const Key& key : config_keys()) {
    if (key.path.ends_with("." + path)) node.fail("unknown key, did you mean '" + key.path + "'?");
    if (dot != path.npos || key.path.find('.') == key.path.npos) known.push_back(key.path);
  }
  std::string near = nearest_name(path, known);
  if (!near.empty()) node.fail("unknown key, did you mean '" + near + "'?");
  std::vector<std::string> heads;
  for (const Key& key : config_keys()) {
    if (key.path.find('.') == key.path.npos) heads.push_back(key.path);
  }
  node.fail("unknown key" + suggestion(head, heads));
}

void unknown_key(const Node& node, const std::string& section, const std::string& name) {
  std::vector<std::string> known;
  for (const Key& key : config_keys()) {
    if (section.empty() ? key.path.find('.') == key.path.npos : key.path.starts_with(section + ".")) {
      known.push_back(section.empty() ? key.path : key.path.substr(section.size() + 1));
    }
  }
  if (section.empty()) known.insert(known.end(), {"sweep", "zip"});
  node.member(name).fail("unknown key" + suggestion(name, known));
}

}  // namespace ml
