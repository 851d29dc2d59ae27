#include <array>
#include <cctype>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

// The value of a base64 digit, or -1 (RFC 4648, section 4).
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<std::byte> decode_base64(const File& file, const std::string& where, std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    int digit = base64_digit(c);
    if (digit < 0) file.fail(where, "the data URI is not base64");
    bits = (bits << 6) | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::byte>((bits >> count) & 0xff));
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  auto low = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

std::string decode_percent(std::string_view text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    bool escape =
        text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    result += escape ? static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
    if (escape) i += 2;
  }
  return result;
}

// Of names alone: what a user's own links point to is the user's business.
bool lies_below(const std::filesystem::path& path, const std::filesystem::path& root) {
  const auto whole = [](const std::filesystem::path& p) {
    return std::filesystem::absolute(p.empty() ? "." : p).lexically_normal();
  };
  const std::filesystem::path relative = whole(path).lexically_relative(whole(root));
  return !relative.empty() && *relative.begin() != "..";
}

void check_views(const File& file) {
  for (size_t i = 0; i < file.model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = file.model.bufferViews[i];
    size_t size = file.buffers[static_cast<size_t>(view.buffer)].size(),
           end = view.byteOffset + view.byteLength;
    if (end > size)
      file.fail(at("bufferViews", i), "reaches " + std::to_string(end - size) + " bytes past " +
                                          at("buffers", static_cast<size_t>(view.buffer)));
  }
}

}  // namespace

std::filesystem::path external_path(const File& file, const std::string& where, const std::string& uri) {
  if (!file.external) file.fail(where, "external files are refused here: '" + uri + "'");
  const std::string decoded = decode_percent(uri);
  const std::filesystem::path path(decoded);
  // A colon or a backslash that stands there as itself begins a scheme or a drive, or separates folders
  // elsewhere; one that is written %3A or %5C belongs to a name.
  if (decoded.empty() || !path.is_relative() || uri.find_first_of(":\\") != std::string::npos ||
      decoded.find('\0') != std::string::npos)
    file.fail(where, "expected a file in or below the folder of the glTF, found '" + uri + "'");
  if (!lies_below(file.folder / path, file.root) && !lies_below(file.folder / path, file.folder))
    file.fail(where, "expected a file in or below '" + (file.root.empty() ? "." : file.root.string()) +
                         "', found '" + uri + "'; scene.root names another folder");
  return file.folder / path;
}

std::vector<std::byte> load_uri(const File& file, const std::string& where, const std::string& uri) {
  if (uri.starts_with("data:")) {
    static constexpr std::string_view marker = ";base64,";
    size_t start = uri.substr(0, 256).find(marker);
    if (start == std::string::npos) file.fail(where, "expected a data URI with ';base64,'");
    return decode_base64(file, where, std::string_view(uri).substr(start + marker.size()));
  }
  std::filesystem::path path = external_path(file, where, uri);
  try {
    return read_file(path);
  } catch (const UsageError& error) {
    file.fail(where, error.what());
  }
}

void load_buffers(File& file, std::optional<Bytes> binary) {
  auto buffers = file.json.find("buffers");
  size_t count = buffers == file.json.end() ? 0 : buffers->size();
  // All before the first span is taken: growing would move them.
  file.owned.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const Json& buffer = (*buffers)[i];
    auto length = buffer["byteLength"].get<size_t>();
    Bytes bytes;
    if (buffer.contains("uri")) {
      file.owned[i] = load_uri(file, at("buffers", i) + ".uri", buffer["uri"].get_ref<const std::string&>());
      bytes = file.owned[i];
    } else if (i == 0 && binary) {
      bytes = *binary;
    } else {
      file.fail(at("buffers", i), "has neither a URI nor the binary chunk of a GLB");
    }
    if (length > bytes.size())
      file.fail(at("buffers", i), "byteLength is " + std::to_string(length) + ", but there are " +
                                      std::to_string(bytes.size()) + " bytes");
    file.buffers.push_back(bytes.first(length));
  }
  check_views(file);
}

Bytes view_bytes(const File& file, size_t view) {
  const tinygltf::BufferView& found = file.model.bufferViews[view];
  return file.buffers[static_cast<size_t>(found.buffer)].subspan(found.byteOffset, found.byteLength);
}

}  // namespace ml::gltf
