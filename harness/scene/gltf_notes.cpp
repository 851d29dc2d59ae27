#include "harness/scene/gltf_file.h"

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

}  // namespace

void note_what_is_ignored(File& file, const Json& raw) {
  size_t colored = 0, morphing = 0, skins = 0, textured = 0, extended = 0, emissive = 0, wrapped = 0;
  for_each_object(raw, "meshes", [&](const Json& mesh) {
    for_each_object(mesh, "primitives", [&](const Json& primitive) {
      auto attributes = primitive.find("attributes");
      colored += attributes != primitive.end() && attributes->is_object() && attributes->contains("COLOR_0");
      morphing += primitive.contains("targets");
    });
  });
  for_each_object(raw, "skins", [&](const Json&) { ++skins; });
  for_each_object(raw, "materials", [&](const Json& material) {
    auto surface = material.find("pbrMetallicRoughness");
    bool metal_map =
        surface != material.end() && surface->is_object() && surface->contains("metallicRoughnessTexture");
    textured += metal_map || material.contains("normalTexture") || material.contains("occlusionTexture");
    emissive += material.contains("emissiveTexture") || material.contains("emissiveFactor");
    extended += material.contains("extensions");
  });
  for_each_object(raw, "samplers", [&](const Json& sampler) {
    for (const char* key : {"wrapS", "wrapT"})
      if (auto found = sampler.find(key); found != sampler.end() && *found != TINYGLTF_TEXTURE_WRAP_REPEAT) {
        ++wrapped;
        break;
      }
  });
  add_note(file, colored, "primitives have vertex colours, which are ignored");
  add_note(file, morphing, "primitives have morph targets, which are ignored");
  add_note(file, skins, "skins are ignored: their meshes stand in their rest pose");
  add_note(file, textured,
           "materials have metallic-roughness, normal or occlusion textures, which are ignored");
  add_note(file, emissive, "materials emit light by themselves, which is ignored");
  add_note(file, extended, "materials have extensions, which are ignored");
  add_note(file, wrapped, "texture samplers clamp or mirror; all textures are repeated");
}

}  // namespace ml::gltf
