#include <bit>
#include <cstring>

#include "harness/base/error.h"
#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

constexpr std::string_view magic = "MLLIGHTS";
constexpr uint32_t version = 2;
constexpr size_t header_size = 16, record_size = 92, old_record_size = 64;
constexpr uint32_t probe_bit = 1u << 31;  // of the shape

class Writer {
 public:
  void put32(uint32_t value) { put(value, 4); }
  void put_float(float value) { put(std::bit_cast<uint32_t>(value), 4); }
  void put_double(double value) { put(std::bit_cast<uint64_t>(value), 8); }
  void put_text(std::string_view text) {
    for (char c : text) bytes.push_back(static_cast<std::byte>(c));
  }
  std::vector<std::byte> bytes;

 private:
  void put(uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xff));
  }
};

class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(bytes) {}
  uint32_t get32() { return static_cast<uint32_t>(get(4)); }
  float get_float() { return std::bit_cast<float>(get32()); }
  double get_double() { return std::bit_cast<double>(get(8)); }

 private:
  // The caller has proven that there is enough.
  uint64_t get(size_t size) {
    uint64_t value = 0;
    for (size_t i = 0; i < size; ++i) value |= std::to_integer<uint64_t>(bytes_[i]) << (8 * i);
    bytes_ = bytes_.subspan(size);
    return value;
  }
  Bytes bytes_;
};

}  // namespace

std::vector<std::byte> encode_lights(const std::vector<Light>& lights) {
  Writer out;
  out.bytes.reserve(header_size + record_size * lights.size());
  out.put_text(magic);
  out.put32(version);
  out.put32(static_cast<uint32_t>(lights.size()));
  for (const Light& light : lights) {
    for (int c = 0; c < 3; ++c) out.put_double(light.position[c]);
    out.put_float(light.radius);
    for (int c = 0; c < 3; ++c) out.put_float(light.intensity[c]);
    for (int c = 0; c < 3; ++c) out.put_float(light.direction[c]);
    out.put_float(light.inner_angle);
    out.put_float(light.outer_angle);
    out.put32(static_cast<uint32_t>(light.shape) | (light.probe ? probe_bit : 0));
    for (int c = 0; c < 3; ++c) out.put_float(light.side[c]);
    out.put_float(light.half_length);
    for (int c = 0; c < 3; ++c) out.put_float(light.half_extents[c]);
  }
  return std::move(out.bytes);
}

std::vector<Light> decode_lights(const std::string& name, Bytes bytes) {
  auto fail = [&](const std::string& what) -> void { throw UsageError(name + ": " + what); };
  if (bytes.size() < header_size || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    fail("not a light file: it does not begin with 'MLLIGHTS'");
  Reader in(bytes.subspan(magic.size()));
  const uint32_t found = in.get32();
  if (found != 1 && found != version)
    fail("header: expected version 1 or " + std::to_string(version) + ", found " + std::to_string(found));
  const bool old = found == 1;
  size_t count = in.get32();
  if (count > max_file_lights)
    fail("header: " + std::to_string(count) + " lights, more than " + std::to_string(max_file_lights));
  if (size_t wanted = header_size + (old ? old_record_size : record_size) * count; bytes.size() != wanted)
    fail("header: " + std::to_string(count) + " lights take " + std::to_string(wanted) +
         " bytes, but the file has " + std::to_string(bytes.size()));
  std::vector<Light> lights(count);
  for (size_t i = 0; i < count; ++i) {
    Light& light = lights[i];
    for (int c = 0; c < 3; ++c) light.position[c] = in.get_double();
    light.radius = in.get_float();
    for (int c = 0; c < 3; ++c) light.intensity[c] = in.get_float();
    for (int c = 0; c < 3; ++c) light.direction[c] = in.get_float();
    light.inner_angle = in.get_float();
    light.outer_angle = in.get_float();
    uint32_t shape = in.get32();
    light.probe = !old && (shape & probe_bit) != 0;
    if (light.probe) shape &= ~probe_bit;
    if (const uint32_t max_shape = old ? 1 : 4; shape > max_shape)
      fail(at("lights", i) + ": shape " + std::to_string(shape) + ", expected 0 to " +
           std::to_string(max_shape));
    light.shape = static_cast<LightShape>(shape);
    if (old) continue;
    for (int c = 0; c < 3; ++c) light.side[c] = in.get_float();
    light.half_length = in.get_float();
    for (int c = 0; c < 3; ++c) light.half_extents[c] = in.get_float();
  }
  return lights;
}

}  // namespace ml::gltf
