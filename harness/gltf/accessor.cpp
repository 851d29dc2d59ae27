#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

// Elements in a buffer view, proven to lie inside it.
struct Run {
  Bytes bytes;  // from the first element on
  size_t stride = 0;
  const std::byte* element(size_t i) const { return bytes.data() + i * stride; }
};

// The sizes are below 2^31 by the schema and the strides below 2^8, so that nothing here can overflow 64
// bits.
Run run_of(const File& file, const std::string& where, size_t view, size_t offset, size_t count,
           size_t element_size, size_t stride) {
  Bytes bytes = view_bytes(file, view);
  size_t end = offset + (count - 1) * stride + element_size;
  if (end > bytes.size())
    file.fail(where,
              "reaches " + std::to_string(end - bytes.size()) + " bytes past " + at("bufferViews", view));
  return {bytes.subspan(offset), stride};
}

template <typename T>
T load(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double component(const std::byte* bytes, int type, bool normalized) {
  double value = 0, scale = 1;
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      value = load<int8_t>(bytes), scale = 127;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      value = load<uint8_t>(bytes), scale = 255;
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      value = load<int16_t>(bytes), scale = 32767;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      value = load<uint16_t>(bytes), scale = 65535;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<uint32_t>(bytes);
    default:
      return static_cast<double>(load<float>(bytes));
  }
  return normalized ? std::max(value / scale, -1.0) : value;
}

// Every element of an accessor, sparse ones put in, as `components` doubles (which hold 32-bit integers and
// floats exactly).
std::vector<double> read_all(const File& file, size_t index, size_t components) {
  const tinygltf::Accessor& accessor = file.model.accessors[index];
  std::string where = at("accessors", index);
  auto component_size =
      static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
  size_t element_size = component_size * components;

  Run base;
  if (accessor.bufferView >= 0) {
    auto view = static_cast<size_t>(accessor.bufferView);
    size_t stride = file.model.bufferViews[view].byteStride;
    if (stride == 0) stride = element_size;
    if (stride < element_size)
      file.fail(where, "its elements have " + std::to_string(element_size) + " bytes, but the stride of " +
                           at("bufferViews", view) + " is " + std::to_string(stride));
    base = run_of(file, where, view, accessor.byteOffset, accessor.count, element_size, stride);
  } else if (accessor.count > std::max<size_t>(65536, file.total_bytes())) {
    file.fail(where, "has " + std::to_string(accessor.count) + " elements without a buffer view");
  }
  Run sparse_indices, sparse_values;
  size_t sparse_count = accessor.sparse.isSparse ? static_cast<size_t>(accessor.sparse.count) : 0;
  auto index_size = sparse_count ? static_cast<size_t>(tinygltf::GetComponentSizeInBytes(
                                       static_cast<uint32_t>(accessor.sparse.indices.componentType)))
                                 : 0;
  if (sparse_count) {
    if (sparse_count > accessor.count)
      file.fail(where + ".sparse.count", "is more than the accessor's count");
    sparse_indices =
        run_of(file, where + ".sparse.indices", static_cast<size_t>(accessor.sparse.indices.bufferView),
               static_cast<size_t>(accessor.sparse.indices.byteOffset), sparse_count, index_size, index_size);
    sparse_values = run_of(
        file, where + ".sparse.values", static_cast<size_t>(accessor.sparse.values.bufferView),
        static_cast<size_t>(accessor.sparse.values.byteOffset), sparse_count, element_size, element_size);
  }

  std::vector<double> result(accessor.count * components, 0.0);
  auto put = [&](size_t element, const std::byte* bytes) {
    for (size_t c = 0; c < components; ++c)
      result[element * components + c] =
          component(bytes + c * component_size, accessor.componentType, accessor.normalized);
  };
  if (accessor.bufferView >= 0)
    for (size_t i = 0; i < accessor.count; ++i) put(i, base.element(i));
  for (size_t i = 0; i < sparse_count; ++i) {
    auto element = static_cast<size_t>(
        component(sparse_indices.element(i), accessor.sparse.indices.componentType, false));
    if (element >= accessor.count)
      file.fail(where + ".sparse.indices", "element " + std::to_string(i) + " is " + std::to_string(element) +
                                               ", but the accessor has " + std::to_string(accessor.count) +
                                               " elements");
    put(element, sparse_values.element(i));
  }
  return result;
}

}  // namespace

std::vector<double> read_numbers(const File& file, size_t index, int components, const std::string& where) {
  static const std::map<int, std::pair<const char*, int>> types = {{1, {"SCALAR", TINYGLTF_TYPE_SCALAR}},
                                                                   {2, {"VEC2", TINYGLTF_TYPE_VEC2}},
                                                                   {3, {"VEC3", TINYGLTF_TYPE_VEC3}},
                                                                   {4, {"VEC4", TINYGLTF_TYPE_VEC4}},
                                                                   {16, {"MAT4", TINYGLTF_TYPE_MAT4}}};
  const tinygltf::Accessor& accessor = file.model.accessors[index];
  const auto& [name, wanted] = types.at(components);
  if (accessor.type != wanted)
    file.fail(where, "expected " + std::string(name) + " elements in " + at("accessors", index));
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    file.fail(where, "expected floats or 8- or 16-bit integers in " + at("accessors", index));
  if (accessor.count > max_vertices)
    file.fail(at("accessors", index), "has " + std::to_string(accessor.count) +
                                          " elements, more than the limit of " +
                                          std::to_string(max_vertices));
  std::vector<double> result = read_all(file, index, static_cast<size_t>(components));
  for (size_t i = 0; i < result.size(); ++i)
    if (!std::isfinite(result[i]))
      file.fail(at("accessors", index),
                "element " + std::to_string(i / static_cast<size_t>(components)) + " is not finite");
  return result;
}

std::vector<uint32_t> read_indices(const File& file, size_t index, const std::string& where) {
  const tinygltf::Accessor& accessor = file.model.accessors[index];
  bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
               accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
               accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !whole || accessor.normalized)
    file.fail(where, "expected unsigned 8-, 16- or 32-bit integers in " + at("accessors", index));
  if (accessor.count > max_indices)
    file.fail(at("accessors", index), "has " + std::to_string(accessor.count) +
                                          " indices, more than the limit of " + std::to_string(max_indices));
  std::vector<double> values = read_all(file, index, 1);
  return {values.begin(), values.end()};
}

}  // namespace ml::gltf
