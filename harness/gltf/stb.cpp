// PNG in and out. The one place that compiles stb's reader and writer; static, so that other rooms may have
// theirs.
#include <cstring>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <memory>
#include <string_view>

#include "harness/base/error.h"
#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

std::string reason() {
  const char* text = stbi_failure_reason();
  return text ? text : "unknown reason";
}

uint32_t big_endian(Bytes bytes, size_t offset) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[offset + i]);
  return value;
}

// The reader calls whatever is too large for it unreadable: so the size is looked at before it is asked. A
// PNG begins with eight bytes of its own and the chunk IHDR, which begins with width and height (ISO/IEC
// 15948).
void check_header(const File& file, const std::string& where, Bytes bytes, size_t pixels_left) {
  constexpr std::string_view start("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  constexpr size_t width_at = 16, height_at = 20, end = 24;
  if (bytes.size() < end || std::memcmp(bytes.data(), start.data(), start.size()) != 0) return;
  check_image_size(file, where, big_endian(bytes, width_at), big_endian(bytes, height_at), bytes.size(),
                   pixels_left);
}

}  // namespace

Texture decode_png(const File& file, const std::string& where, Bytes bytes, size_t pixels_left) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  auto size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  check_header(file, where, bytes, pixels_left);
  if (!stbi_info_from_memory(data, size, &width, &height, &channels))
    file.fail(where, "not a PNG or JPEG that can be decoded: " + reason());
  check_image_size(file, where, static_cast<uint32_t>(width), static_cast<uint32_t>(height), bytes.size(),
                   pixels_left);
  std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!decoded) file.fail(where, "the PNG cannot be decoded: " + reason());
  Texture texture;
  texture.width = static_cast<uint32_t>(width);
  texture.height = static_cast<uint32_t>(height);
  texture.rgba.assign(decoded.get(), decoded.get() + size_t{texture.width} * texture.height * 4);
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
