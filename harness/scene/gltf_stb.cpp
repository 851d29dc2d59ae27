// The one place that compiles stb's image reader and writer; static, so that other rooms may have theirs.
#include <cstring>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <memory>

#include "harness/base/error.h"
#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

// Deflate makes at most 1032 bytes out of one (and a PNG holds at least 1 bit per pixel), progressive JPEG
// some 10^4 pixels.
constexpr size_t pixels_per_byte = 16384;

std::string reason() {
  const char* text = stbi_failure_reason();
  return text ? text : "unknown reason";
}

}  // namespace

Texture decode_image(const File& file, const std::string& place, Bytes bytes, size_t pixels_left) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  if (bytes.size() > 0x7fffffff) file.fail(place, "the image is larger than 2 GiB");
  auto size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels))
    file.fail(place, "not a PNG or JPEG that can be decoded: " + reason());
  if (width <= 0 || height <= 0) file.fail(place, "the image has no pixels");
  size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  std::string extent = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (pixels > pixels_left) file.fail(place, extent + " are more than all textures may have together");
  if (pixels / pixels_per_byte > bytes.size())
    file.fail(place, extent + " cannot come out of " + std::to_string(bytes.size()) + " bytes");

  std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!decoded) file.fail(place, "the image cannot be decoded: " + reason());
  Texture texture;
  texture.width = static_cast<uint32_t>(width);
  texture.height = static_cast<uint32_t>(height);
  texture.rgba.assign(decoded.get(), decoded.get() + pixels * 4);
  return texture;
}

std::vector<std::byte> encode_png(const Texture& texture) {
  int size = 0;
  auto width = static_cast<int>(texture.width), height = static_cast<int>(texture.height);
  std::unique_ptr<unsigned char, void (*)(void*)> encoded(
      stbi_write_png_to_mem(texture.rgba.data(), width * 4, width, height, 4, &size), std::free);
  if (!encoded) throw SystemError("cannot encode texture '" + texture.name + "' as PNG: out of memory");
  std::vector<std::byte> bytes(static_cast<size_t>(size));
  std::memcpy(bytes.data(), encoded.get(), bytes.size());
  return bytes;
}

}  // namespace ml::gltf
