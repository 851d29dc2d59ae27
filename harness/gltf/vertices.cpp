#include "harness/gltf/vertices.h"

#include <algorithm>
#include <cmath>

namespace ml::gltf {
namespace {

constexpr size_t base_slot = static_cast<size_t>(TextureSlot::base_color);

int attribute_of(const tinygltf::Primitive& primitive, const std::string& name) {
  auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

std::vector<double> read_attribute(const File& file, int accessor, int components, size_t count,
                                   const std::string& where) {
  auto index = static_cast<size_t>(accessor);
  if (file.model.accessors[index].count != count)
    file.fail(where, at("accessors", index) + " has " + std::to_string(file.model.accessors[index].count) +
                         " elements, but there are " + std::to_string(count) + " positions");
  return read_numbers(file, index, components, where);
}

std::vector<glm::vec2> moved(const std::vector<double>& values, const TextureMapping& map) {
  std::vector<glm::vec2> result(values.size() / 2);
  double c = map.rotation == 0 ? 1 : std::cos(map.rotation),
         s = map.rotation == 0 ? 0 : std::sin(map.rotation);
  for (size_t i = 0; i < result.size(); ++i) {
    double u = values[2 * i] * map.scale.x, v = values[2 * i + 1] * map.scale.y;
    glm::dvec2 mapped(c * u + s * v + map.offset.x, c * v - s * u + map.offset.y);
    result[i] = glm::vec2(glm::clamp(mapped, -1e6, 1e6));
  }
  return result;
}

// Linear, of three or four components. Integers stand for [0, 1] also where a file forgets to say so.
std::vector<glm::vec4> read_colors(const File& file, int accessor, size_t count, const std::string& where) {
  const tinygltf::Accessor& source = file.model.accessors[static_cast<size_t>(accessor)];
  const int components = source.type == TINYGLTF_TYPE_VEC3 ? 3 : 4;
  const std::vector<double> values = read_attribute(file, accessor, components, count, where);
  double one = 1;
  if (!source.normalized && source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) one = 255;
  if (!source.normalized && source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) one = 65535;
  std::vector<glm::vec4> colors(count, glm::vec4(1));
  constexpr double largest = 65504;  // of half floats, as they are kept on the device
  for (size_t i = 0; i < count; ++i)
    for (int c = 0; c < components; ++c)
      colors[i][c] = static_cast<float>(std::clamp(
          values[i * static_cast<size_t>(components) + static_cast<size_t>(c)] / one, 0.0, largest));
  return colors;
}

bool same(const VertexSource::Coordinates& a, const VertexSource::Coordinates& b) {
  return a.accessor == b.accessor && a.mapping == b.mapping;
}

std::vector<glm::vec2>* details_uv(VertexDetails& details, size_t slot) {
  switch (static_cast<TextureSlot>(slot)) {
    case TextureSlot::metallic_roughness:
      return &details.metallic_roughness_uv;
    case TextureSlot::normal:
      return &details.normal_uv;
    case TextureSlot::emission:
      return &details.emission_uv;
    default:
      return nullptr;
  }
}

// The list up to and with element `last`; what it lacks has the default.
template <typename T>
T& grown(std::vector<T>& list, size_t last, const T& missing) {
  list.resize(last + 1, missing);
  return list[last];
}

glm::vec2& grown_uv(std::vector<glm::vec2>& list, const Scene& scene) {
  while (list.size() < scene.vertices.size()) list.push_back(scene.vertices[list.size()].uv);
  return list.back();
}

}  // namespace

glm::dvec3 unit(const glm::dvec3& v) {
  double length = glm::length(v);
  if (!std::isfinite(length) || length < 1e-150) return glm::dvec3(0);
  return std::abs(length - 1) < 1e-6 ? v : v / length;
}

VertexSource::VertexSource(const File& file, const tinygltf::Primitive& primitive, std::string used_in)
    : where(std::move(used_in)), positions(static_cast<size_t>(attribute_of(primitive, "POSITION"))) {
  normals = attribute_of(primitive, "NORMAL");
  colors = attribute_of(primitive, "COLOR_0");
  for (size_t slot = 0; slot < texture_slots; ++slot) {
    const auto name = static_cast<TextureSlot>(slot);
    coordinates[slot].mapping = texture_mapping(file, primitive.material, name);
    coordinates[slot].accessor =
        attribute_of(primitive, "TEXCOORD_" + std::to_string(coordinates[slot].mapping.set));
    const bool wanted = has_texture(file, primitive.material, name);
    lacks_coordinates = lacks_coordinates || (wanted && coordinates[slot].accessor < 0);
    own_coordinates[slot] = slot != base_slot && wanted && !same(coordinates[slot], coordinates[base_slot]);
  }
  // Flat normals have no use for a file's tangents (glTF 2.0, 3.7.2.1), nor has a material without normal
  // map.
  if (normals >= 0 && has_texture(file, primitive.material, TextureSlot::normal))
    tangents = attribute_of(primitive, "TANGENT");
}

std::vector<double> VertexSource::key() const {
  std::vector<double> key{static_cast<double>(positions), static_cast<double>(normals),
                          static_cast<double>(tangents), static_cast<double>(colors)};
  for (size_t slot = 0; slot < texture_slots; ++slot) {
    if (slot != base_slot && !own_coordinates[slot]) continue;
    const TextureMapping& map = coordinates[slot].mapping;
    key.insert(key.end(), {static_cast<double>(slot), static_cast<double>(coordinates[slot].accessor),
                           map.offset.x, map.offset.y, map.scale.x, map.scale.y, map.rotation});
  }
  return key;
}

VertexAttributes::VertexAttributes(const File& file, const VertexSource& source) {
  const std::string attributes = source.where + ".attributes.";
  std::vector<double> values = read_numbers(file, source.positions, 3, attributes + "POSITION");
  const size_t count = values.size() / 3;
  positions.resize(count);
  for (size_t i = 0; i < count; ++i) positions[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  if (source.normals >= 0) {
    values = read_attribute(file, source.normals, 3, count, attributes + "NORMAL");
    for (size_t i = 0; i < count; ++i)
      normals.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  if (source.tangents >= 0) {
    values = read_attribute(file, source.tangents, 4, count, attributes + "TANGENT");
    for (size_t i = 0; i < count; ++i)
      tangents.emplace_back(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]);
  }
  if (source.colors >= 0) colors = read_colors(file, source.colors, count, attributes + "COLOR_0");
  for (size_t slot = 0; slot < texture_slots; ++slot) {
    if (slot != base_slot && !source.own_coordinates[slot]) continue;
    const VertexSource::Coordinates& from = source.coordinates[slot];
    uvs[slot].assign(count, glm::vec2(0));
    if (from.accessor < 0) continue;
    const std::string name = attributes + "TEXCOORD_" + std::to_string(from.mapping.set);
    uvs[slot] = moved(read_attribute(file, from.accessor, 2, count, name), from.mapping);
  }
}

void add_details(const VertexAttributes& attributes, size_t i, const glm::dmat3* transform, Scene& scene) {
  const size_t last = scene.vertices.size() - 1;
  VertexDetails& details = scene.details;
  if (!attributes.colors.empty()) grown(details.colors, last, glm::vec4(1)) = attributes.colors[i];
  if (transform && !attributes.tangents.empty()) {
    const glm::dvec4& own = attributes.tangents[i];
    const glm::dvec3 tangent = unit(*transform * glm::dvec3(own));
    // A mirrored node turns the frame of normal, tangent and bitangent inside out.
    double sign = own.w < 0 ? -1 : 1;
    if (glm::determinant(*transform) < 0) sign = -sign;
    if (tangent == glm::dvec3(0)) sign = 0;
    grown(details.tangents, last, glm::vec4(0)) = glm::vec4(glm::dvec4(tangent, sign));
  }
  for (size_t slot = 0; slot < texture_slots; ++slot)
    if (std::vector<glm::vec2>* list = details_uv(details, slot); list && !attributes.uvs[slot].empty())
      grown_uv(*list, scene) = attributes.uvs[slot][i];
}

void finish_details(Scene& scene) {
  VertexDetails& details = scene.details;
  const size_t last = scene.vertices.size() - 1;
  if (!details.colors.empty()) grown(details.colors, last, glm::vec4(1));
  if (!details.tangents.empty()) grown(details.tangents, last, glm::vec4(0));
  for (auto* list : {&details.metallic_roughness_uv, &details.normal_uv, &details.emission_uv})
    if (!list->empty()) grown_uv(*list, scene);
}

}  // namespace ml::gltf
