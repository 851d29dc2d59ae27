#include <cstring>

#include "harness/base/error.h"
#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

constexpr uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr uint32_t bin_chunk = 0x004E4942;   // "BIN\0"
constexpr size_t header_size = 12, chunk_header_size = 8;

uint32_t word(Bytes bytes, size_t offset) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value |= std::to_integer<uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

std::string_view text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container open_glb(const File& file, Bytes bytes) {
  if (bytes.size() < header_size)
    file.fail("header", "a GLB starts with 12 bytes, but the file has " + std::to_string(bytes.size()));
  if (word(bytes, 4) != 2)
    file.fail("header", "expected GLB version 2, found " + std::to_string(word(bytes, 4)));
  size_t length = word(bytes, 8);
  if (length > bytes.size())
    file.fail("header", "the length is " + std::to_string(length) + " bytes, but the file has " +
                            std::to_string(bytes.size()));

  Container container;
  size_t offset = header_size;
  for (size_t chunk = 0; offset < length; ++chunk) {
    std::string where = at("chunk", chunk);
    if (length - offset < chunk_header_size) file.fail(where, "its header is cut off");
    size_t size = word(bytes, offset);
    uint32_t type = word(bytes, offset + 4);
    offset += chunk_header_size;
    if (size > length - offset)
      file.fail(where,
                "reaches " + std::to_string(size - (length - offset)) + " bytes past the end of the file");
    if (chunk == 0 && type != json_chunk) file.fail(where, "expected the JSON chunk first");
    if (chunk == 0) container.json = text(bytes.subspan(offset, size));
    if (chunk == 1 && type == bin_chunk) container.binary = bytes.subspan(offset, size);
    offset += size;
  }
  if (offset == header_size) file.fail("header", "the file has no JSON chunk");
  return container;
}

}  // namespace

void File::fail(const std::string& where, const std::string& what) const {
  throw UsageError(name + ": " + where + ": " + what);
}

size_t File::total_bytes() const {
  size_t total = 0;
  for (Bytes buffer : buffers) total += buffer.size();
  return total;
}

std::string at(const char* array, size_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

Container open_container(const File& file, Bytes bytes) {
  if (bytes.empty()) throw UsageError(file.name + ": the file is empty");
  if (bytes.size() >= 4 && word(bytes, 0) == glb_magic) return open_glb(file, bytes);
  return {text(bytes), std::nullopt};
}

}  // namespace ml::gltf
