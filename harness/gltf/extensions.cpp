// Which glTF a file is, and what it asks for beyond it.
#include <algorithm>
#include <map>

#include "harness/base/error.h"
#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

const std::vector<std::string>& known_extensions() {
  static const std::vector<std::string> names = {"KHR_lights_punctual",   "KHR_mesh_quantization",
                                                 "KHR_texture_transform", "EXT_mesh_gpu_instancing",
                                                 "KHR_node_visibility",   "KHR_materials_emissive_strength"};
  return names;
}

bool is_known(const std::string& name) {
  return std::find(known_extensions().begin(), known_extensions().end(), name) != known_extensions().end();
}

// Without these a level has other colours or stands still, but has the same meshes in the same positions: the
// name, or all that begin with it, and what becomes of it.
const char* what_is_lost(const std::string& name) {
  static const std::pair<const char*, const char*> kinds[] = {
      {"KHR_materials_", "materials are drawn without it"},
      {"KHR_texture_", "its textures are drawn white"},
      {"EXT_texture_", "its textures are drawn white"},
      {"MSFT_texture_", "its textures are drawn white"},
      {"KHR_animation_pointer", "what it moves stands still"},
      {"KHR_xmp", "nothing is lost"}};
  for (const auto& [prefix, loss] : kinds)
    if (name.starts_with(prefix)) return loss;
  return nullptr;
}

// A member of an object that may be anything, null where there is none.
const Json& member(const Json& parent, const char* key) {
  static const Json none;
  if (!parent.is_object()) return none;
  auto found = parent.find(key);
  return found == parent.end() ? none : *found;
}

// Whether arrays of glTF 2.0 are objects with names, as glTF 1.0 has them.
bool looks_like_version_1(const Json& raw) {
  for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"})
    if (member(raw, key).is_object()) return true;
  return false;
}

void check_version(const File& file, const Json& raw) {
  const Json& version = member(member(raw, "asset"), "version");
  const std::string found = version.is_string() ? version.get<std::string>() : "";
  if (found.starts_with("1.") || (found.empty() && looks_like_version_1(raw)))
    file.fail("asset.version", "the file is glTF 1.0, but 2.0 is needed");
  // What has no version at all is left to the schema.
  if (!found.empty() && !found.starts_with("2."))
    file.fail("asset.version", "expected glTF 2.x, found '" + found + "'");
  if (const Json& least = member(member(raw, "asset"), "minVersion"); least.is_string() && least != "2.0")
    file.fail("asset.minVersion", "expected 2.0, found '" + least.get<std::string>() + "'");
}

[[noreturn]] void fail_compressed(const File& file, const std::string& where, const std::string& name) {
  file.fail(where, "the file needs " + name + ", which is not supported");
}

bool has_bytes(const Json& raw, const Json& accessor) {
  const Json& accessors = member(raw, "accessors");
  if (!accessor.is_number_unsigned() || !accessors.is_array()) return true;
  const auto index = accessor.get<size_t>();
  return index >= accessors.size() || !accessors[index].is_object() ||
         accessors[index].contains("bufferView") || accessors[index].contains("sparse");
}

// Compressed meshes without an uncompressed copy, also where a file does not say that it needs the extension.
void check_compression(const File& file, const Json& raw) {
  static const char* const draco = "KHR_draco_mesh_compression";
  const Json& meshes = member(raw, "meshes");
  for (size_t m = 0; meshes.is_array() && m < meshes.size(); ++m) {
    const Json& primitives = member(meshes[m], "primitives");
    for (size_t p = 0; primitives.is_array() && p < primitives.size(); ++p) {
      if (!member(member(primitives[p], "extensions"), draco).is_object()) continue;
      bool whole = has_bytes(raw, member(primitives[p], "indices"));
      if (const Json& attributes = member(primitives[p], "attributes"); attributes.is_object())
        for (const auto& [name, accessor] : attributes.items()) whole = whole && has_bytes(raw, accessor);
      if (!whole) fail_compressed(file, at("meshes", m) + "." + at("primitives", p), draco);
    }
  }
  const Json& buffers = member(raw, "buffers");
  for (size_t i = 0; buffers.is_array() && i < buffers.size(); ++i)
    for (const char* meshopt : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (member(member(member(buffers[i], "extensions"), meshopt), "fallback") == true &&
          !member(buffers[i], "uri").is_string())
        fail_compressed(file, at("buffers", i), meshopt);
}

void check_required(File& file, const Json& raw) {
  const Json& needed = member(raw, "extensionsRequired");
  if (needed.is_null()) return;
  if (!needed.is_array()) file.fail("extensionsRequired", "expected an array");
  for (size_t i = 0; i < needed.size(); ++i) {
    const std::string where = at("extensionsRequired", i);
    if (!needed[i].is_string()) file.fail(where, "expected a string");
    const auto name = needed[i].get<std::string>();
    if (is_known(name)) continue;
    if (const char* loss = what_is_lost(name)) {
      file.notes.push_back(one_line("the file needs " + name + ", which is not supported: " + loss));
      continue;
    }
    const std::string near = nearest_name(name, known_extensions());
    file.fail(where, "the file needs " + name + ", which is not supported" +
                         (near.empty() ? "" : ", did you mean '" + near + "'?"));
  }
}

// Calls visit(name) for every member of every "extensions" in the description; what belongs to others
// (extras) is left alone.
template <typename Visit>
void for_each_extension(const Json& raw, Visit&& visit) {
  std::vector<const Json*> pending{&raw};
  while (!pending.empty()) {
    const Json& value = *pending.back();
    pending.pop_back();
    if (value.is_array())
      for (const Json& item : value)
        if (item.is_structured()) pending.push_back(&item);
    if (!value.is_object()) continue;
    for (const auto& [key, item] : value.items()) {
      if (key == "extras" || !item.is_structured()) continue;
      if (key == "extensions" && item.is_object())
        for (const auto& [name, extension] : item.items()) visit(name);
      pending.push_back(&item);
    }
  }
}

}  // namespace

void check_version_and_extensions(File& file, const Json& raw) {
  check_version(file, raw);
  check_required(file, raw);
  check_compression(file, raw);
}

void note_unknown_extensions(File& file, const Json& raw) {
  constexpr size_t max_names = 24;  // more than any honest file has
  std::map<std::string, size_t> uses;
  for_each_extension(raw, [&](const std::string& name) {
    if (!is_known(name)) ++uses[name];
  });
  size_t shown = 0;
  for (const auto& [name, count] : uses) {
    if (shown++ == max_names) break;
    file.notes.push_back(one_line(std::to_string(count) + (count == 1 ? " use of " : " uses of ") + name +
                                  ", which is ignored"));
  }
  if (uses.size() > max_names)
    file.notes.push_back(std::to_string(uses.size() - max_names) + " more extensions are ignored");
}

}  // namespace ml::gltf
