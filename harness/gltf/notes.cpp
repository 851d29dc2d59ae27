#include <string>

#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

// Calls visit(object) for every object of an array that may not be there or not be an array.
template <typename Visit>
void for_each_object(const Json& parent, const char* key, Visit&& visit) {
  auto found = parent.find(key);
  if (found == parent.end() || !found->is_array()) return;
  for (const Json& item : *found)
    if (item.is_object()) visit(item);
}

void add_note(File& file, size_t count, const std::string& what) {
  if (count) file.notes.push_back(std::to_string(count) + " " + what);
}

// Attributes are sets with numbers (TEXCOORD_0): whether a name is a set of that kind which is not read.
bool is_further_set(const std::string& name, const std::string& kind, int read) {
  if (!name.starts_with(kind) || name.size() == kind.size()) return false;
  for (int i = 0; i < read; ++i)
    if (name == kind + std::to_string(i)) return false;
  return true;
}

void note_attributes(File& file, const Json& raw) {
  size_t morphing = 0, colors = 0, further = 0, own = 0;
  for_each_object(raw, "meshes", [&](const Json& mesh) {
    for_each_object(mesh, "primitives", [&](const Json& primitive) {
      morphing += primitive.contains("targets");
      auto attributes = primitive.find("attributes");
      if (attributes == primitive.end() || !attributes->is_object()) return;
      for (const auto& [name, accessor] : attributes->items()) {
        colors += is_further_set(name, "COLOR_", 1);
        further += is_further_set(name, "TEXCOORD_", 8) || is_further_set(name, "JOINTS_", 8) ||
                   is_further_set(name, "WEIGHTS_", 8);
        own += name.starts_with("_");
      }
    });
  });
  add_note(file, morphing, "primitives have morph targets, which are ignored");
  add_note(file, colors, "sets of vertex colours behind the first are ignored");
  add_note(file, further, "sets of texture coordinates, joints or weights behind the eighth are ignored");
  add_note(file, own, "vertex attributes of the file's own (_NAME) are ignored");
}

}  // namespace

void note_what_is_ignored(File& file, const Json& raw) {
  note_attributes(file, raw);
  size_t occluded = 0;
  for_each_object(raw, "materials",
                  [&](const Json& material) { occluded += material.contains("occlusionTexture"); });
  add_note(file, occluded, "materials have occlusion textures, which are ignored");
}

}  // namespace ml::gltf
