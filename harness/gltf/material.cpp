#include <algorithm>
#include <cmath>

#include "harness/gltf/parts.h"
#include "harness/gltf/textures.h"

namespace ml::gltf {
namespace {

constexpr double max_emission = 1e9;  // W/m^2/sr

float unit_factor(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

// Of a material's JSON.
const Json::json_pointer& pointer_to(TextureSlot slot) {
  static const Json::json_pointer pointers[texture_slots] = {
      "/pbrMetallicRoughness/baseColorTexture"_json_pointer,
      "/pbrMetallicRoughness/metallicRoughnessTexture"_json_pointer, "/normalTexture"_json_pointer,
      "/emissiveTexture"_json_pointer};
  return pointers[static_cast<size_t>(slot)];
}

class MaterialLoader {
 public:
  MaterialLoader(File& file, Scene& scene) : file_(file), scene_(scene), textures_(file, scene) {}

  void load() {
    size_t blended = 0, index = 0;
    for (const tinygltf::Material& source : file_.model.materials) {
      const Json& json = file_.json["materials"][index++];
      Material material;
      material.name = source.name;
      const auto& surface = source.pbrMetallicRoughness;
      for (int c = 0; c < 4; ++c)
        material.base_color[c] = unit_factor(surface.baseColorFactor[static_cast<size_t>(c)]);
      material.metallic = unit_factor(surface.metallicFactor);
      material.roughness = unit_factor(surface.roughnessFactor);
      material.double_sided = source.doubleSided;
      if (source.alphaMode != "OPAQUE") material.alpha_mode = AlphaMode::mask;
      if (source.alphaMode == "MASK")
        material.alpha_cutoff = static_cast<float>(std::min(source.alphaCutoff, 1e6));
      blended += source.alphaMode == "BLEND";
      material.base_color_texture = texture(json, TextureSlot::base_color);
      material.metallic_roughness_texture = texture(json, TextureSlot::metallic_roughness);
      material.normal_texture = texture(json, TextureSlot::normal);
      material.normal_scale =
          static_cast<float>(std::clamp(json.value("/normalTexture/scale"_json_pointer, 1.0), -1e6, 1e6));
      set_emission(json, material);
      material.forward = json.value("/extras/manylights/forward"_json_pointer, false);
      scene_.materials.push_back(std::move(material));
    }
    Material plain;
    plain.name = "no material";
    scene_.materials.push_back(plain);
    if (blended)
      file_.notes.push_back(std::to_string(blended) +
                            " materials blend, and are drawn as masks with cutoff 0.5");
    textures_.add_notes();
  }

 private:
  int texture(const Json& material, TextureSlot slot) {
    const auto& pointer = pointer_to(slot);
    return material.contains(pointer) ? textures_.get(material[pointer]["index"].get<size_t>()) : -1;
  }

  // Without a factor there is no emission, whatever the texture says.
  void set_emission(const Json& json, Material& material) {
    const double strength =
        json.value("/extensions/KHR_materials_emissive_strength/emissiveStrength"_json_pointer, 1.0);
    if (json.contains("emissiveFactor"))
      for (int c = 0; c < 3; ++c)
        material.emission[c] = static_cast<float>(std::clamp(
            json["emissiveFactor"][static_cast<size_t>(c)].get<double>() * strength, 0.0, max_emission));
    if (material.emission != glm::vec3(0)) material.emission_texture = texture(json, TextureSlot::emission);
  }

  File& file_;
  Scene& scene_;
  TextureLoader textures_;
};

}  // namespace

void load_materials(File& file, Scene& scene) {
  MaterialLoader(file, scene).load();
}

bool has_texture(const File& file, int material, TextureSlot slot) {
  return material >= 0 && file.json["materials"][static_cast<size_t>(material)].contains(pointer_to(slot));
}

TextureMapping texture_mapping(const File& file, int material, TextureSlot slot) {
  TextureMapping mapping;
  if (!has_texture(file, material, slot)) return mapping;
  const Json& texture = file.json["materials"][static_cast<size_t>(material)][pointer_to(slot)];
  mapping.set = texture.value("texCoord", 0);
  const Json transform = texture.value("/extensions/KHR_texture_transform"_json_pointer, Json::object());
  mapping.set = transform.value("texCoord", mapping.set);
  mapping.rotation = transform.value("rotation", 0.0);
  for (int c = 0; c < 2; ++c) {
    auto i = static_cast<size_t>(c);
    if (transform.contains("offset")) mapping.offset[c] = transform["offset"][i];
    if (transform.contains("scale")) mapping.scale[c] = transform["scale"][i];
  }
  return mapping;
}

}  // namespace ml::gltf
