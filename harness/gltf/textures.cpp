#include "harness/gltf/textures.h"

#include <algorithm>
#include <string_view>

#include "harness/base/error.h"

namespace ml::gltf {
namespace {

constexpr uint32_t max_side = 16384;  // pixels
// Deflate makes at most 1032 bytes out of one (and a PNG holds at least 1 bit per pixel), progressive JPEG
// some 10^4 pixels.
constexpr size_t pixels_per_byte = 16384;

// The name of a picture format that files have and the importer does not read, or null.
const char* other_format(Bytes bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 16));
  if (text.starts_with("RIFF") && text.substr(8).starts_with("WEBP")) return "WebP";
  if (text.starts_with("\xabKTX 20")) return "KTX 2";
  if (text.starts_with("DDS ")) return "DDS";
  if (text.starts_with("GIF8")) return "GIF";
  if (text.starts_with("BM")) return "BMP";
  if (text.substr(std::min<size_t>(text.size(), 4)).starts_with("ftypavif")) return "AVIF";
  if (text.starts_with("II*") || text.starts_with("MM")) return "TIFF";
  return nullptr;
}

Texture decode(const File& file, const std::string& where, Bytes bytes, size_t pixels_left) {
  if (bytes.empty()) file.fail(where, "the image is empty");
  if (bytes.size() > 0x7fffffff) file.fail(where, "the image is larger than 2 GiB");
  if (const char* format = other_format(bytes))
    file.fail(where, "expected a PNG or a JPEG, found " + std::string(format));
  return is_jpeg(bytes) ? decode_jpeg(file, where, bytes, pixels_left)
                        : decode_png(file, where, bytes, pixels_left);
}

}  // namespace

void check_image_size(const File& file, const std::string& where, uint32_t width, uint32_t height,
                      size_t bytes, size_t pixels_left) {
  size_t pixels = size_t{width} * height;
  std::string extent = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (pixels == 0) file.fail(where, "the image has no pixels");
  if (width > max_side || height > max_side)
    file.fail(where, "the image is too large: " + extent + ", more than 16384 on a side");
  if (pixels > pixels_left)
    file.fail(where, "the image is too large: " + extent + " are more than all textures may have together");
  if (pixels / pixels_per_byte > bytes)
    file.fail(where, extent + " cannot come out of " + std::to_string(bytes) + " bytes");
}

std::optional<Texture> TextureLoader::decoded(size_t image) {
  if (unreadable_.contains(image)) return std::nullopt;
  const std::string where = at("images", image);
  const Json& source = file_.json["images"][image];
  try {
    std::vector<std::byte> owned;
    Bytes bytes;
    std::string name;
    if (source.contains("uri")) {
      const auto& uri = source["uri"].get_ref<const std::string&>();
      owned = load_uri(file_, where + ".uri", uri);
      bytes = owned;
      if (!uri.starts_with("data:")) name = uri;
    } else if (source.contains("bufferView")) {
      bytes = view_bytes(file_, source["bufferView"].get<size_t>());
    } else {
      file_.fail(where, "has neither a URI nor a buffer view");
    }
    Texture texture = decode(file_, where, bytes, pixels_left_);
    pixels_left_ -= size_t{texture.width} * texture.height;
    texture.name = source.value("name", name);
    return texture;
  } catch (const UsageError& error) {
    // The file's name stands before every note already.
    std::string why = error.what();
    if (why.starts_with(file_.name + ": ")) why = why.substr(file_.name.size() + 2);
    unreadable_.emplace(image, why);
    return std::nullopt;
  }
}

Sampler TextureLoader::sampler_of(size_t texture) {
  Sampler sampler;
  const int index = file_.model.textures[texture].sampler;
  if (index < 0) return sampler;
  const Json& source = file_.json["samplers"][static_cast<size_t>(index)];
  bool strange = false;
  auto wrap = [&](const char* key) {
    switch (source.value(key, TINYGLTF_TEXTURE_WRAP_REPEAT)) {
      case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return Wrap::repeat;
      case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirrored_repeat;
      case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp_to_edge;
      default:
        strange = true;
        return Wrap::repeat;
    }
  };
  sampler.u = wrap("wrapS");
  sampler.v = wrap("wrapT");
  // glTF leaves it to the program what happens where a file does not say: linear, from the whole picture.
  const int magnify = source.value("magFilter", TINYGLTF_TEXTURE_FILTER_LINEAR),
            minify = source.value("minFilter", TINYGLTF_TEXTURE_FILTER_LINEAR);
  switch (magnify) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      sampler.magnify = Filter::nearest;
      break;
    default:
      strange = strange || magnify != TINYGLTF_TEXTURE_FILTER_LINEAR;
  }
  switch (minify) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      sampler.minify = Filter::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      sampler.minify = Filter::nearest, sampler.mip = MipFilter::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      sampler.mip = MipFilter::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      sampler.minify = Filter::nearest, sampler.mip = MipFilter::linear;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
      sampler.mip = MipFilter::linear;
      break;
    default:
      strange = strange || minify != TINYGLTF_TEXTURE_FILTER_LINEAR;
  }
  strange_samplers_ += strange;
  return sampler;
}

int TextureLoader::get(size_t texture) {
  const int source = file_.model.textures[texture].source;
  if (source < 0) {
    ++without_image_;
    return -1;
  }
  const auto image = static_cast<size_t>(source);
  const std::tuple key(image, sampler_of(texture));
  if (auto found = known_.find(key); found != known_.end()) return found->second;
  std::optional<Texture> picture = decoded(image);
  if (!picture) return -1;
  picture->sampler = std::get<Sampler>(key);
  scene_.textures.push_back(std::move(*picture));
  const auto index = static_cast<int>(scene_.textures.size()) - 1;
  known_.emplace(key, index);
  return index;
}

void TextureLoader::add_notes() {
  auto note = [&](size_t count, const std::string& what) {
    if (count) file_.notes.push_back(one_line(std::to_string(count) + " " + what));
  };
  note(without_image_, "textures have no PNG or JPEG image, and are drawn white");
  if (!unreadable_.empty())
    note(unreadable_.size(),
         "images cannot be read, and are drawn white (normal maps flat): " + unreadable_.begin()->second);
  note(strange_samplers_,
       "textures have a sampler with values that glTF does not know, taken as its defaults");
}

}  // namespace ml::gltf
