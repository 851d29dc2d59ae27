#include "harness/gltf/glb_writer.h"

#include <algorithm>
#include <bit>

namespace ml::gltf {
namespace {

constexpr int component_float = 5126, component_uint32 = 5125;
static_assert(std::endian::native == std::endian::little, "vertices are written as they lie in memory");

void put32(std::vector<std::byte>& bytes, size_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xff));
}

}  // namespace

size_t GlbWriter::add_view(std::span<const std::byte> bytes, Target target) {
  OrderedJson view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  binary_.insert(binary_.end(), bytes.begin(), bytes.end());
  binary_.resize((binary_.size() + 3) / 4 * 4);
  json_["bufferViews"].push_back(std::move(view));
  return json_["bufferViews"].size() - 1;
}

size_t GlbWriter::add_floats(std::span<const float> values, size_t components, Target target, bool bounds) {
  static const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  OrderedJson accessor = {{"bufferView", add_view(std::as_bytes(values), target)},
                          {"componentType", component_float},
                          {"count", values.size() / components},
                          {"type", types[components]}};
  if (bounds) {
    OrderedJson low = OrderedJson::array(), high = OrderedJson::array();
    for (size_t c = 0; c < components; ++c) {
      float min = values[c], max = values[c];
      for (size_t i = c; i < values.size(); i += components)
        min = std::min(min, values[i]), max = std::max(max, values[i]);
      low.push_back(min);
      high.push_back(max);
    }
    accessor["min"] = std::move(low);
    accessor["max"] = std::move(high);
  }
  json_["accessors"].push_back(std::move(accessor));
  return json_["accessors"].size() - 1;
}

size_t GlbWriter::add_indices(std::span<const uint32_t> indices, size_t view, size_t first) {
  json_["accessors"].push_back({{"bufferView", view},
                                {"byteOffset", first * sizeof(uint32_t)},
                                {"componentType", component_uint32},
                                {"count", indices.size()},
                                {"type", "SCALAR"}});
  return json_["accessors"].size() - 1;
}

std::vector<std::byte> GlbWriter::finish() {
  json_["buffers"] = OrderedJson::array({{{"byteLength", binary_.size()}}});
  std::string text = json_.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> file;
  file.reserve(28 + text.size() + binary_.size());
  put32(file, 0x46546C67);  // "glTF"
  put32(file, 2);
  put32(file, 28 + text.size() + binary_.size());
  put32(file, text.size());
  put32(file, 0x4E4F534A);  // "JSON"
  for (char c : text) file.push_back(static_cast<std::byte>(c));
  put32(file, binary_.size());
  put32(file, 0x004E4942);  // "BIN\0"
  file.insert(file.end(), binary_.begin(), binary_.end());
  return file;
}

}  // namespace ml::gltf
