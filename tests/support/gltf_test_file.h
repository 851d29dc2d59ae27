// A glTF file put together by hand: for the tests, and for the fuzzer's seeds.
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "harness/gltf/gltf.h"
#include "harness/scene/scene.h"

namespace ml {

using Json = nlohmann::json;

struct GltfTestFile {
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::byte> binary;

  template <typename T>
  int view(const std::vector<T>& values) {
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}});
    const auto* bytes = reinterpret_cast<const std::byte*>(values.data());
    binary.insert(binary.end(), bytes, bytes + values.size() * sizeof(T));
    binary.resize((binary.size() + 3) / 4 * 4);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <typename T>
  int accessor(const std::vector<T>& values, int component_type, const std::string& type,
               bool normalized = false) {
    static const std::map<std::string, size_t> widths = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    json["accessors"].push_back({{"bufferView", view(values)},
                                 {"componentType", component_type},
                                 {"count", values.size() / widths.at(type)},
                                 {"type", type}});
    if (normalized) json["accessors"].back()["normalized"] = true;
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int floats(const std::vector<float>& values, const std::string& type) {
    return accessor(values, 5126, type);
  }

  // A mesh of one primitive; without indices where there are none.
  int mesh(const std::vector<float>& positions, const std::vector<uint32_t>& indices = {}) {
    Json primitive = {{"attributes", {{"POSITION", floats(positions, "VEC3")}}}};
    if (!indices.empty()) primitive["indices"] = accessor(indices, 5125, "SCALAR");
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    return static_cast<int>(json["meshes"].size()) - 1;
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }

  // "buffers" follows the binary chunk unless a test has written its own.
  std::string glb() const {
    Json description = json;
    if (!binary.empty() && !description.contains("buffers"))
      description["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    return glb_of(description.dump(), binary);
  }

  static std::string glb_of(std::string text, const std::vector<std::byte>& binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    auto put = [&](size_t value) {
      auto word = static_cast<uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&word), 4);
    };
    put(2);
    put(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    put(text.size());
    file += "JSON" + text;
    if (binary.empty()) return file;
    put(binary.size());
    file.append("BIN\0", 4);
    file.append(reinterpret_cast<const char*>(binary.data()), binary.size());
    return file;
  }

  Scene load(int scene = -1, const glm::dvec3& offset = glm::dvec3(0)) const {
    return load_bytes(glb(), scene, offset);
  }

  static Scene load_bytes(const std::string& bytes, int scene = -1,
                          const glm::dvec3& offset = glm::dvec3(0)) {
    return import_gltf_memory(std::as_bytes(std::span(bytes)), "test.glb", scene, 1, offset);
  }
};

// One triangle in the plane y = 0, facing up, on one node, with a camera that looks at it from above.
inline GltfTestFile triangle_file() {
  GltfTestFile file;
  file.mesh({0, 0, 0, 0, 0, 4, 4, 0, 0}, {0, 1, 2});
  file.json["nodes"] = Json::array({{{"mesh", 0}}, {{"camera", 0}, {"translation", {0, 5, 0}}}});
  file.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}});
  file.json["scenes"] = Json::array({{{"nodes", {0, 1}}}});
  return file;
}

// Corner `corner` of triangle `triangle`, in the file's own world.
inline glm::dvec3 corner_of(const Scene& scene, size_t triangle, size_t corner) {
  return glm::dvec3(scene.vertices[scene.indices[3 * triangle + corner]].position) + scene.origin;
}

}  // namespace ml
