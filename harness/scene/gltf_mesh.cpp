#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

glm::dvec3 triple(const std::vector<double>& values, size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

// For normals: the inverse transpose up to a positive factor, so that it exists for flattened nodes too.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

// A unit vector, or zero where there is none. A vector that is unit length in float already keeps its bits.
glm::dvec3 unit(const glm::dvec3& v) {
  double length = glm::length(v);
  if (!std::isfinite(length) || length < 1e-150) return glm::dvec3(0);
  return std::abs(length - 1) < 1e-6 ? v : v / length;
}

// The corners of the triangles that a list, strip or fan of `corners` means; incomplete ones at the end are
// dropped.
std::vector<uint32_t> as_triangles(const std::vector<uint32_t>& corners, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES)
    return {corners.begin(), corners.begin() + static_cast<ptrdiff_t>(corners.size() / 3 * 3)};
  std::vector<uint32_t> result;
  for (size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      result.insert(result.end(), {corners[i + 1], corners[i + 2], corners[0]});
    else  // every second triangle of a strip is turned, so that all face the same way
      result.insert(result.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  return result;
}

class MeshLoader {
 public:
  MeshLoader(File& file, Scene& scene) : file_(file), scene_(scene), triangles_(scene.materials.size()) {}

  void add_node(const PlacedNode& placed) {
    int mesh = file_.model.nodes[placed.node].mesh;
    if (mesh < 0) return;
    const auto& primitives = file_.model.meshes[static_cast<size_t>(mesh)].primitives;
    shared_.clear();
    for (size_t i = 0; i < primitives.size(); ++i)
      add_primitive(placed, primitives[i],
                    at("meshes", static_cast<size_t>(mesh)) + "." + at("primitives", i));
  }

  glm::dvec3 finish(const glm::dvec3* given_center) {
    note(not_triangles_, "primitives are points or lines, which are not drawn");
    note(without_positions_, "primitives have no positions, and are not drawn");
    note(without_material_, "primitives have no material, and get white, not metallic, roughness 0.8");
    size_t corners = 0;
    for (const auto& list : triangles_) corners += list.size();
    if (corners == 0) file_.fail("scene", "has no triangles");
    if (triangles_.back().empty() && scene_.materials.size() > 1)
      triangles_.pop_back(), scene_.materials.pop_back();

    glm::dvec3 center = given_center ? *given_center : whole_center();
    for (size_t i = 0; i < positions_.size(); ++i)
      scene_.vertices[i].position = glm::vec3(positions_[i] - center);
    scene_.indices.reserve(corners);
    for (size_t material = 0; material < triangles_.size(); ++material) {
      const auto& list = triangles_[material];
      if (list.empty()) continue;
      scene_.draws.push_back({static_cast<uint32_t>(scene_.indices.size()),
                              static_cast<uint32_t>(list.size()), static_cast<uint32_t>(material)});
      scene_.indices.insert(scene_.indices.end(), list.begin(), list.end());
    }
    mend_normals();
    scene_.bounds = {scene_.vertices[0].position, scene_.vertices[0].position};
    for (const Vertex& vertex : scene_.vertices) {
      scene_.bounds.min = glm::min(scene_.bounds.min, vertex.position);
      scene_.bounds.max = glm::max(scene_.bounds.max, vertex.position);
    }
    return center;
  }

 private:
  struct Source {
    size_t positions;
    int normals, coordinates;
    TextureMapping mapping;
    std::string place;
  };

  void note(size_t count, const std::string& what) {
    if (count) file_.notes.push_back(std::to_string(count) + " " + what);
  }

  void add_primitive(const PlacedNode& placed, const tinygltf::Primitive& primitive,
                     const std::string& place) {
    int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    auto positions = primitive.attributes.find("POSITION");
    not_triangles_ += mode < TINYGLTF_MODE_TRIANGLES;
    without_positions_ += mode >= TINYGLTF_MODE_TRIANGLES && positions == primitive.attributes.end();
    if (mode < TINYGLTF_MODE_TRIANGLES || positions == primitive.attributes.end()) return;

    Source source{static_cast<size_t>(positions->second), -1, -1, texture_mapping(file_, primitive.material),
                  place};
    if (auto found = primitive.attributes.find("NORMAL"); found != primitive.attributes.end())
      source.normals = found->second;
    if (auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(source.mapping.set));
        found != primitive.attributes.end())
      source.coordinates = found->second;

    size_t count = file_.model.accessors[source.positions].count;
    std::vector<uint32_t> corners = triangle_corners(primitive, mode, count, place);
    without_material_ += primitive.material < 0;
    size_t material =
        primitive.material < 0 ? triangles_.size() - 1 : static_cast<size_t>(primitive.material);
    std::vector<uint32_t>& list = triangles_[material];
    check_room(source.normals < 0 ? corners.size() : count, corners.size(), place);

    glm::dmat3 linear(placed.world);
    if (glm::determinant(linear) < 0)
      for (size_t i = 0; i + 2 < corners.size(); i += 3) std::swap(corners[i + 1], corners[i + 2]);
    if (source.normals >= 0) {
      uint32_t base = shared_vertices(placed, source);
      for (uint32_t corner : corners) list.push_back(base + corner);
    } else {
      add_flat(placed, source, corners, list);
    }
  }

  std::vector<uint32_t> triangle_corners(const tinygltf::Primitive& primitive, int mode, size_t vertices,
                                         const std::string& place) const {
    std::vector<uint32_t> corners;
    if (primitive.indices < 0) {
      if (vertices > max_vertices)
        file_.fail(place, "has " + std::to_string(vertices) + " vertices, more than the limit of " +
                              std::to_string(max_vertices));
      corners.resize(vertices);
      for (size_t i = 0; i < vertices; ++i) corners[i] = static_cast<uint32_t>(i);
    } else {
      corners = read_indices(file_, static_cast<size_t>(primitive.indices), place + ".indices");
      for (size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertices)
          file_.fail(place + ".indices", at("accessors", static_cast<size_t>(primitive.indices)) +
                                             " element " + std::to_string(i) + " is " +
                                             std::to_string(corners[i]) + ", but there are " +
                                             std::to_string(vertices) + " vertices");
    }
    return as_triangles(corners, mode);
  }

  // Before memory is asked for: one mesh may stand on very many nodes.
  void check_room(size_t vertices, size_t corners, const std::string& place) {
    corners_ += corners;
    if (scene_.vertices.size() + vertices > max_vertices || corners_ > max_indices)
      file_.fail(place, "the scene has more than " + std::to_string(max_vertices) + " vertices or triangles");
  }

  std::vector<double> attribute(int accessor, int components, size_t count, const Source& source,
                                const char* name) const {
    std::string place = source.place + ".attributes." + name;
    auto index = static_cast<size_t>(accessor);
    if (file_.model.accessors[index].count != count)
      file_.fail(place, at("accessors", index) + " has " +
                            std::to_string(file_.model.accessors[index].count) + " elements, but there are " +
                            std::to_string(count) + " positions");
    return read_numbers(file_, index, components, place);
  }

  std::vector<glm::dvec3> world_positions(const PlacedNode& placed, const Source& source) const {
    std::vector<double> values =
        read_numbers(file_, source.positions, 3, source.place + ".attributes.POSITION");
    std::vector<glm::dvec3> result(values.size() / 3);
    for (size_t i = 0; i < result.size(); ++i) {
      result[i] = glm::dvec3(placed.world * glm::dvec4(triple(values, i), 1));
      for (int c = 0; c < 3; ++c)
        if (!(std::abs(result[i][c]) <= max_coordinate))
          file_.fail(source.place, "on " + at("nodes", placed.node) + " its vertex " + std::to_string(i) +
                                       " lies more than 1e9 m from the origin");
    }
    return result;
  }

  std::vector<glm::vec2> coordinates(const Source& source, size_t count) const {
    std::vector<glm::vec2> result(count, glm::vec2(0));
    if (source.coordinates < 0) return result;
    std::string name = "TEXCOORD_" + std::to_string(source.mapping.set);
    std::vector<double> values = attribute(source.coordinates, 2, count, source, name.c_str());
    const TextureMapping& map = source.mapping;
    double c = map.rotation == 0 ? 1 : std::cos(map.rotation),
           s = map.rotation == 0 ? 0 : std::sin(map.rotation);
    for (size_t i = 0; i < count; ++i) {
      double u = values[2 * i] * map.scale.x, v = values[2 * i + 1] * map.scale.y;
      glm::dvec2 moved(c * u + s * v + map.offset.x, c * v - s * u + map.offset.y);
      result[i] = glm::vec2(glm::clamp(moved, -1e6, 1e6));
    }
    return result;
  }

  // The first of the vertices that all primitives of this node with the same attributes share.
  uint32_t shared_vertices(const PlacedNode& placed, const Source& source) {
    const TextureMapping& map = source.mapping;
    Key key{source.positions, source.normals, source.coordinates, map.offset.x,
            map.offset.y,     map.scale.x,    map.scale.y,        map.rotation};
    if (auto found = shared_.find(key); found != shared_.end()) return found->second;
    std::vector<glm::dvec3> positions = world_positions(placed, source);
    std::vector<double> normals = attribute(source.normals, 3, positions.size(), source, "NORMAL");
    std::vector<glm::vec2> uv = coordinates(source, positions.size());
    glm::dmat3 matrix = normal_matrix(glm::dmat3(placed.world));
    auto base = static_cast<uint32_t>(scene_.vertices.size());
    for (size_t i = 0; i < positions.size(); ++i)
      add_vertex(positions[i], unit(matrix * triple(normals, i)), uv[i]);
    shared_.emplace(key, base);
    return base;
  }

  // glTF: a mesh without normals is drawn with flat ones, so that no two triangles share a vertex.
  void add_flat(const PlacedNode& placed, const Source& source, const std::vector<uint32_t>& corners,
                std::vector<uint32_t>& list) {
    std::vector<glm::dvec3> positions = world_positions(placed, source);
    std::vector<glm::vec2> uv = coordinates(source, positions.size());
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
      glm::dvec3 a = positions[corners[i]], b = positions[corners[i + 1]], c = positions[corners[i + 2]];
      glm::dvec3 normal = unit(glm::cross(b - a, c - a));
      for (size_t k = 0; k < 3; ++k) {
        list.push_back(static_cast<uint32_t>(scene_.vertices.size()));
        add_vertex(positions[corners[i + k]], normal, uv[corners[i + k]]);
      }
    }
  }

  void add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::vec2& uv) {
    positions_.push_back(position);
    scene_.vertices.push_back({glm::vec3(0), glm::vec3(normal), uv});
  }

  glm::dvec3 whole_center() const {
    glm::dvec3 low = positions_[0], high = low;
    for (const glm::dvec3& position : positions_)
      low = glm::min(low, position), high = glm::max(high, position);
    return glm::floor(0.5 * (low + high) + 0.5);
  }

  // A vertex whose own normal is no direction gets the area-weighted one of its triangles, and "up" where
  // those have no area.
  void mend_normals() {
    std::vector<uint32_t> bad;
    for (size_t i = 0; i < scene_.vertices.size(); ++i)
      if (scene_.vertices[i].normal == glm::vec3(0)) bad.push_back(static_cast<uint32_t>(i));
    if (bad.empty()) return;
    std::map<uint32_t, glm::dvec3> sums;
    for (uint32_t vertex : bad) sums.emplace(vertex, glm::dvec3(0));
    for (size_t i = 0; i < scene_.indices.size(); i += 3) {
      glm::dvec3 a = positions_[scene_.indices[i]], b = positions_[scene_.indices[i + 1]],
                 c = positions_[scene_.indices[i + 2]];
      for (size_t k = 0; k < 3; ++k)
        if (auto sum = sums.find(scene_.indices[i + k]); sum != sums.end())
          sum->second += glm::cross(b - a, c - a);
    }
    for (const auto& [vertex, sum] : sums) {
      glm::dvec3 normal = unit(sum);
      scene_.vertices[vertex].normal = normal == glm::dvec3(0) ? glm::vec3(0, 1, 0) : glm::vec3(normal);
    }
  }

  using Key = std::tuple<size_t, int, int, double, double, double, double, double>;

  File& file_;
  Scene& scene_;
  std::vector<glm::dvec3> positions_;             // m, in the file's world; beside scene_.vertices
  std::vector<std::vector<uint32_t>> triangles_;  // for each material
  std::map<Key, uint32_t> shared_;
  size_t corners_ = 0;
  size_t not_triangles_ = 0, without_positions_ = 0, without_material_ = 0;
};

}  // namespace

glm::dvec3 load_meshes(File& file, const std::vector<PlacedNode>& nodes, const glm::dvec3* center,
                       Scene& scene) {
  MeshLoader loader(file, scene);
  for (const PlacedNode& node : nodes) loader.add_node(node);
  return loader.finish(center);
}

}  // namespace ml::gltf
