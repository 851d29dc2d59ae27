#include "harness/config/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/base/error.h"
#include "scenes/scene_registry.h"

namespace ml {

namespace {

using nlohmann::json;

constexpr double farthest = 1e9;  // m, any coordinate
constexpr uint32_t max_seed = 0xffffffffu;
constexpr uint32_t max_frames = 100000;
constexpr size_t max_keyframes = 1000;
constexpr const char* auto_word = "auto";

glm::dvec3 read_vector(const Node& node) {
  node.list(3, 3);
  return {node.item(0).real(-farthest, farthest), node.item(1).real(-farthest, farthest),
          node.item(2).real(-farthest, farthest)};
}

json write_vector(const glm::dvec3& v) {
  return json::array({v.x, v.y, v.z});
}

// A length in metres where 0 means "not given"; what a float would round to 0 is refused.
float read_length(const Node& node) {
  double metres = node.real(0, 1e6);
  if (metres != 0 && metres < 1e-6) node.expected("0 or a number from 1e-06 to 1000000");
  return static_cast<float>(metres);
}

void read_light_count(const Node& node, LightSpec& lights) {
  lights.auto_count = node.json() == auto_word;
  if (lights.auto_count) {
    lights.count = LightSpec().count;
  } else if (node.json().is_string()) {
    node.expected("an integer from 0 to 1048576 or \"auto\"");
  } else {
    lights.count = node.unsigned_integer(0, 1048576);
  }
}

void read_scene_name(const Node& node, SceneSpec& scene) {
  std::string name = node.text(1, 100);
  if (!find_scene(name)) {
    node.fail("unknown scene '" + name + "'" + suggestion(name, scene_names()) +
              " (a file is given as {\"gltf\": \"level.glb\"})");
  }
  scene.procedural = name;
  scene.gltf.clear();
  scene.root.clear();
  scene.gltf_scene = -1;
}

void read_scene_file(const Node& node, SceneSpec& scene) {
  std::filesystem::path file(node.text(1, 4096));
  scene.gltf = std::filesystem::absolute(node.source().relative_to / file).lexically_normal();
  scene.procedural.clear();
  try {
    json(scene.gltf.string()).dump();
  } catch (const json::exception&) {
    node.fail("the folder's path is not UTF-8, and a result could not name it");
  }
}

// Relative to the configuration, as the level's own file is.
void read_scene_root(const Node& node, SceneSpec& scene) {
  scene.root =
      std::filesystem::absolute(node.source().relative_to / std::filesystem::path(node.text(1, 4096)))
          .lexically_normal();
  try {
    json(scene.root.string()).dump();
  } catch (const json::exception&) {
    node.fail("the folder's path is not UTF-8, and a result could not name it");
  }
}

std::vector<CameraKey> read_keyframes(const Node& node) {
  std::vector<CameraKey> keys;
  for (size_t i = 0, count = node.list(1, max_keyframes); i < count; ++i) {
    Node item = node.item(i);
    item.object();
    static const std::vector<std::string> names{"time", "position", "target"};
    for (const auto& [key, value] : item.json().items()) {
      if (std::find(names.begin(), names.end(), key) == names.end()) {
        item.member(key).fail("unknown key" + suggestion(key, names));
      }
    }
    for (const std::string& name : names) {
      if (!item.json().contains(name)) item.fail("the key '" + name + "' is missing");
    }
    CameraKey key{item.member("time").real(-1e9, 1e9), read_vector(item.member("position")),
                  read_vector(item.member("target"))};
    if (!keys.empty() && key.time <= keys.back().time) {
      item.member("time").expected(fmt::format("a time after the one before ({} s)", keys.back().time));
    }
    keys.push_back(key);
  }
  return keys;
}

json write_keyframes(const std::vector<CameraKey>& keys) {
  json list = json::array();
  for (const CameraKey& key : keys) {
    list.push_back(
        {{"time", key.time}, {"position", write_vector(key.position)}, {"target", write_vector(key.target)}});
  }
  return list;
}

// Frame numbers, each once.
std::vector<uint32_t> read_frames(const Node& node) {
  std::vector<uint32_t> frames;
  for (size_t i = 0, count = node.list(0, max_frames); i < count; ++i) {
    frames.push_back(node.item(i).unsigned_integer(0, max_frames - 1));
  }
  std::vector<uint32_t> sorted = frames;
  std::sort(sorted.begin(), sorted.end());
  if (auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    node.fail(fmt::format("frame {} is there twice", *twice));
  }
  return frames;
}

bool read_auto_off(const Node& node) {
  static const std::vector<std::string> words{auto_word, "off"};
  return node.choice(words) == 0;
}

json write_auto_off(bool automatic) {
  return automatic ? auto_word : "off";
}

template <typename Enum>
Enum read_enum(const Node& node, const std::vector<std::string>& names) {
  return static_cast<Enum>(node.choice(names));
}

template <typename Enum>
json write_enum(Enum value, const std::vector<std::string>& names) {
  return names[static_cast<size_t>(value)];
}

const std::vector<std::string>& timing_mode_names() {
  static const std::vector<std::string> names{"stages", "whole"};
  return names;
}

const std::vector<std::string>& shading_target_names() {
  static const std::vector<std::string> names{"one", "split"};
  return names;
}

const std::vector<std::string>& list_queue_names() {
  static const std::vector<std::string> names{"graphics", "compute"};
  return names;
}

const std::vector<std::string>& light_fetch_names() {
  static const std::vector<std::string> names{"auto", "storage", "texel"};
  return names;
}

}  // namespace

std::span<const Field<SceneSpec>> scene_fields() {
  static constexpr auto fields = std::to_array<Field<SceneSpec>>({
      {"name", read_scene_name,
       [](const SceneSpec& s) { return s.procedural.empty() ? json() : json(s.procedural); }},
      {"gltf", read_scene_file,
       [](const SceneSpec& s) { return s.gltf.empty() ? json() : json(s.gltf.string()); }},
      {"scene",
       [](const Node& n, SceneSpec& s) {
         if (s.gltf.empty()) n.fail("only a glTF file has several scenes");
         s.gltf_scene = static_cast<int>(n.integer(-1, 1000000));
       },
       [](const SceneSpec& s) { return s.gltf.empty() ? json() : json(s.gltf_scene); }},
      {"root",
       [](const Node& n, SceneSpec& s) {
         if (s.gltf.empty()) n.fail("only a glTF file has a folder that its textures lie in");
         read_scene_root(n, s);
       },
       [](const SceneSpec& s) { return s.root.empty() ? json() : json(s.root.string()); }},
      {"seed", [](const Node& n, SceneSpec& s) { s.seed = n.unsigned_integer(0, max_seed); },
       [](const SceneSpec& s) { return json(s.seed); }},
      {"offset", [](const Node& n, SceneSpec& s) { s.offset = read_vector(n); },
       [](const SceneSpec& s) { return write_vector(s.offset); }},
      {"two_sided", [](const Node& n, SceneSpec& s) { s.two_sided = n.boolean(); },
       [](const SceneSpec& s) { return json(s.two_sided); }},
  });
  return fields;
}

std::span<const Field<LightSpec>> light_fields() {
  using L = LightSpec;
  static constexpr auto fields = std::to_array<Field<L>>({
      {"placement", [](const Node& n, L& l) { l.placement = read_enum<Placement>(n, placement_names()); },
       [](const L& l) { return l.placement ? write_enum(*l.placement, placement_names()) : json(); }},
      {"count", read_light_count,
       [](const L& l) {
         return l.auto_count && l.placement == Placement::gltf ? json(auto_word) : json(l.count);
       }},
      {"sizing", [](const Node& n, L& l) { l.sizing = read_enum<Sizing>(n, sizing_names()); },
       [](const L& l) { return write_enum(l.sizing, sizing_names()); }},
      {"base_size", [](const Node& n, L& l) { l.base_size = read_length(n); },
       [](const L& l) { return json(shortest_double(l.base_size)); }},
      {"radius_ratio", [](const Node& n, L& l) { l.radius_ratio = static_cast<float>(n.real(1, 1000)); },
       [](const L& l) { return l.radius_ratio > 0 ? json(shortest_double(l.radius_ratio)) : json(); }},
      {"radius", [](const Node& n, L& l) { l.radius = read_length(n); },
       [](const L& l) { return json(shortest_double(l.radius)); }},
      {"height", [](const Node& n, L& l) { l.height = read_length(n); },
       [](const L& l) { return json(shortest_double(l.height)); }},
      {"spot_fraction", [](const Node& n, L& l) { l.spot_fraction = static_cast<float>(n.real(0, 1)); },
       [](const L& l) { return json(shortest_double(l.spot_fraction)); }},
      {"capsule_fraction", [](const Node& n, L& l) { l.capsule_fraction = static_cast<float>(n.real(0, 1)); },
       [](const L& l) { return json(shortest_double(l.capsule_fraction)); }},
      {"wedge_fraction", [](const Node& n, L& l) { l.wedge_fraction = static_cast<float>(n.real(0, 1)); },
       [](const L& l) { return json(shortest_double(l.wedge_fraction)); }},
      {"box_fraction", [](const Node& n, L& l) { l.box_fraction = static_cast<float>(n.real(0, 1)); },
       [](const L& l) { return json(shortest_double(l.box_fraction)); }},
      {"probe_fraction", [](const Node& n, L& l) { l.probe_fraction = static_cast<float>(n.real(0, 1)); },
       [](const L& l) { return json(shortest_double(l.probe_fraction)); }},
      {"intensity", [](const Node& n, L& l) { l.intensity = static_cast<float>(n.real(1e-9, 1e9)); },
       [](const L& l) { return json(shortest_double(l.intensity)); }},
      {"seed", [](const Node& n, L& l) { l.seed = n.unsigned_integer(0, max_seed); },
       [](const L& l) { return json(l.seed); }},
      {"animate", [](const Node& n, L& l) { l.script = read_enum<LightScript>(n, light_script_names()); },
       [](const L& l) { return l.script ? write_enum(*l.script, light_script_names()) : json(); }},
  });
  return fields;
}

std::span<const Field<CameraSpec>> camera_fields() {
  static constexpr auto fields = std::to_array<Field<CameraSpec>>({
      {"path",
       [](const Node& n, CameraSpec& c) {
         c.path = n.text(1, 100);
         c.keyframes.clear();
       },
       [](const CameraSpec& c) { return c.keyframes.empty() ? json(c.path) : json(); }},
      {"frames", [](const Node& n, CameraSpec& c) { c.frames = n.unsigned_integer(1, max_frames); },
       [](const CameraSpec& c) { return json(c.frames); }},
      {"keyframes",
       [](const Node& n, CameraSpec& c) {
         c.keyframes = read_keyframes(n);
         c.path = CameraSpec().path;
       },
       [](const CameraSpec& c) { return c.keyframes.empty() ? json() : write_keyframes(c.keyframes); }},
  });
  return fields;
}

// One for each effect of the table that can be switched off.
template <size_t... rows>
std::vector<Field<Effects>> make_effects_fields(std::index_sequence<rows...>) {
  std::vector<Field<Effects>> fields;
  const auto add = [&](const char* key, auto read, auto write) {
    if (key) fields.push_back({key, read, write});
  };
  (add(
       effect_table[rows].key, [](const Node& n, Effects& e) { e.*effect_table[rows].on = read_auto_off(n); },
       [](const Effects& e) { return write_auto_off(e.*effect_table[rows].on); }),
   ...);
  return fields;
}

std::span<const Field<Effects>> effects_fields() {
  static const std::vector<Field<Effects>> fields =
      make_effects_fields(std::make_index_sequence<effect_table.size()>());
  return fields;
}

std::span<const Field<ShadingSpec>> shading_fields() {
  using S = ShadingSpec;
  static constexpr auto fields = std::to_array<Field<S>>({
      {"targets",
       [](const Node& n, S& s) { s.targets = read_enum<ShadingTargets>(n, shading_target_names()); },
       [](const S& s) { return write_enum(s.targets, shading_target_names()); }},
      {"shadow_maps", [](const Node& n, S& s) { s.shadow_maps = n.unsigned_integer(0, 16); },
       [](const S& s) { return json(s.shadow_maps); }},
      {"shadow_map_size", [](const Node& n, S& s) { s.shadow_map_size = n.unsigned_integer(16, 8192); },
       [](const S& s) { return json(s.shadow_map_size); }},
      {"list_queue", [](const Node& n, S& s) { s.list_queue = read_enum<ListQueue>(n, list_queue_names()); },
       [](const S& s) { return write_enum(s.list_queue, list_queue_names()); }},
      {"light_fetch",
       [](const Node& n, S& s) { s.light_fetch = read_enum<LightFetch>(n, light_fetch_names()); },
       [](const S& s) { return write_enum(s.light_fetch, light_fetch_names()); }},
      {"test_ahead", [](const Node& n, S& s) { s.test_ahead = n.boolean(); },
       [](const S& s) { return json(s.test_ahead); }},
  });
  return fields;
}

std::span<const Field<MeasureSpec>> measure_fields() {
  using M = MeasureSpec;
  static constexpr auto fields = std::to_array<Field<M>>({
      {"warmup", [](const Node& n, M& m) { m.warmup = n.unsigned_integer(0, 1000); },
       [](const M& m) { return json(m.warmup); }},
      {"repeats", [](const Node& n, M& m) { m.repeats = n.unsigned_integer(1, 10000); },
       [](const M& m) { return json(m.repeats); }},
      {"threads", [](const Node& n, M& m) { m.threads = n.unsigned_integer(1, 256); },
       [](const M& m) { return json(m.threads); }},
      {"seed", [](const Node& n, M& m) { m.seed = n.unsigned_integer(0, max_seed); },
       [](const M& m) { return json(m.seed); }},
      {"mode", [](const Node& n, M& m) { m.mode = read_enum<TimingMode>(n, timing_mode_names()); },
       [](const M& m) { return write_enum(m.mode, timing_mode_names()); }},
  });
  return fields;
}

std::span<const Field<OutputSpec>> output_fields() {
  using O = OutputSpec;
  static constexpr auto fields = std::to_array<Field<O>>({
      {"heatmaps", [](const Node& n, O& o) { o.heatmaps = read_frames(n); },
       [](const O& o) { return json(o.heatmaps); }},
      {"images", [](const Node& n, O& o) { o.images = read_frames(n); },
       [](const O& o) { return json(o.images); }},
      {"trace", [](const Node& n, O& o) { o.trace = n.boolean(); }, [](const O& o) { return json(o.trace); }},
  });
  return fields;
}

std::string scene_label(const SceneSpec& scene) {
  return scene.gltf.empty() ? scene.procedural : scene.gltf.stem().string();
}

void read_resolution(const Node& node, Setup& setup) {
  node.list(2, 2);
  setup.width = node.item(0).unsigned_integer(1, 32768);
  setup.height = node.item(1).unsigned_integer(1, 32768);
}

}  // namespace ml
