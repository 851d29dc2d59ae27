#include <algorithm>
#include <map>

#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

constexpr uint32_t max_side = 16384;  // pixels
// Deflate makes at most 1032 bytes out of one (and a PNG holds at least 1 bit per pixel), progressive JPEG
// some 10^4 pixels.
constexpr size_t pixels_per_byte = 16384;

float unit_factor(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

class MaterialLoader {
 public:
  MaterialLoader(File& file, Scene& scene) : file_(file), scene_(scene) {}

  void load() {
    size_t blended = 0, index = 0;
    for (const tinygltf::Material& source : file_.model.materials) {
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
      if (surface.baseColorTexture.index >= 0)
        material.base_color_texture = texture(static_cast<size_t>(surface.baseColorTexture.index));
      const Json& json = file_.json["materials"][index++];
      material.forward = json.value("/extras/manylights/forward"_json_pointer, false);
      scene_.materials.push_back(std::move(material));
    }
    Material plain;
    plain.name = "no material";
    scene_.materials.push_back(plain);
    if (blended)
      file_.notes.push_back(std::to_string(blended) +
                            " materials blend, and are drawn as masks with cutoff 0.5");
    if (without_image_)
      file_.notes.push_back(std::to_string(without_image_) +
                            " textures have no PNG or JPEG image, and are drawn white");
  }

 private:
  // The index in Scene::textures of the image behind a texture of the file; each image is decoded once.
  int texture(size_t index) {
    int image = file_.model.textures[index].source;
    if (image < 0) {
      ++without_image_;
      return -1;
    }
    if (auto found = decoded_.find(image); found != decoded_.end()) return found->second;
    std::string place = at("images", static_cast<size_t>(image));
    const Json& source = file_.json["images"][static_cast<size_t>(image)];
    std::vector<std::byte> owned;
    Bytes bytes;
    std::string name;
    if (source.contains("uri")) {
      const auto& uri = source["uri"].get_ref<const std::string&>();
      owned = load_uri(file_, place + ".uri", uri);
      bytes = owned;
      if (!uri.starts_with("data:")) name = uri;
    } else if (source.contains("bufferView")) {
      bytes = view_bytes(file_, source["bufferView"].get<size_t>());
    } else {
      file_.fail(place, "has neither a URI nor a buffer view");
    }
    if (bytes.size() > 0x7fffffff) file_.fail(place, "the image is larger than 2 GiB");
    Texture texture = is_jpeg(bytes) ? decode_jpeg(file_, place, bytes, pixels_left_)
                                     : decode_png(file_, place, bytes, pixels_left_);
    pixels_left_ -= size_t{texture.width} * texture.height;
    texture.name = source.value("name", name);
    auto result = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    decoded_.emplace(image, result);
    return result;
  }

  File& file_;
  Scene& scene_;
  std::map<int, int> decoded_;
  size_t pixels_left_ = max_pixels;
  size_t without_image_ = 0;
};

}  // namespace

void check_image_size(const File& file, const std::string& place, uint32_t width, uint32_t height,
                      size_t bytes, size_t pixels_left) {
  size_t pixels = size_t{width} * height;
  std::string extent = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (pixels == 0) file.fail(place, "the image has no pixels");
  if (width > max_side || height > max_side) file.fail(place, extent + ", more than 16384 on a side");
  if (pixels > pixels_left) file.fail(place, extent + " are more than all textures may have together");
  if (pixels / pixels_per_byte > bytes)
    file.fail(place, extent + " cannot come out of " + std::to_string(bytes) + " bytes");
}

void load_materials(File& file, Scene& scene) {
  MaterialLoader(file, scene).load();
}

TextureMapping texture_mapping(const File& file, int material) {
  TextureMapping mapping;
  if (material < 0) return mapping;
  const Json& source = file.json["materials"][static_cast<size_t>(material)];
  const Json texture = source.value("/pbrMetallicRoughness/baseColorTexture"_json_pointer, Json::object());
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
