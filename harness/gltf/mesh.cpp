#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/gltf/placement.h"
#include "harness/gltf/vertices.h"

namespace ml::gltf {
namespace {

// For normals: the inverse transpose up to a positive factor, so that it exists for flattened nodes too.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
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
  MeshLoader(File& file, const Movement& movement, Scene& scene)
      : file_(file), movement_(movement), scene_(scene), triangles_(scene.materials.size()) {}

  void add_node(const PlacedNode& placed) {
    const tinygltf::Node& node = file_.model.nodes[placed.node];
    if (node.mesh < 0) return;
    if (!placed.visible) {
      ++hidden_;
      return;
    }
    std::vector<glm::dmat4> joints;
    if (node.skin >= 0) {
      if (worlds_.empty()) worlds_ = world_transforms(file_);
      joints = joint_matrices(file_, static_cast<size_t>(node.skin), worlds_);
    }
    const std::vector<glm::dmat4> worlds = instance_transforms(file_, placed);
    check_instances(placed, worlds.size());
    for (const glm::dmat4& world : worlds) {
      add_mesh(placed, world, joints);
      if (!joints.empty()) break;  // the joints say where it stands, once
    }
  }

  glm::dvec3 finish(const glm::dvec3* given_center) {
    note(not_triangles_, "primitives are points or lines, which are not drawn");
    note(without_positions_, "primitives have no positions, and are not drawn");
    note(hidden_, "meshes are hidden (KHR_node_visibility), and are not drawn");
    note(without_coordinates_,
         "primitives lack the texture coordinates that their textures ask for, and show one point of them");
    note(without_material_, "primitives have no material, and get white, not metallic, roughness 0.8");
    size_t corners = 0;
    for (const auto& list : triangles_) corners += list.size();
    for (const auto& [key, mover] : movers_) corners += mover.triangles.size();
    if (corners == 0) file_.fail("scene", "has no triangles");
    if (triangles_.back().empty() && !moves_without_material_ && scene_.materials.size() > 1)
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
    add_moving_draws(center);
    finish_details(scene_);
    mend_normals();
    scene_.bounds = {scene_.vertices[0].position, scene_.vertices[0].position};
    for (const Vertex& vertex : scene_.vertices) {
      scene_.bounds.min = glm::min(scene_.bounds.min, vertex.position);
      scene_.bounds.max = glm::max(scene_.bounds.max, vertex.position);
    }
    return center;
  }

 private:
  // Triangles that a moving node carries, of one material.
  struct Mover {
    glm::dmat4 world{1};  // where the node is while its vertices are made
    std::vector<uint32_t> triangles;
  };

  // A node that has no volume at any time is drawn as it stands: nothing of it is seen. Skinned meshes stand
  // where their joints are at rest.
  std::vector<uint32_t>& triangles_of(const PlacedNode& placed, size_t material, bool skinned) {
    const int node = skinned ? -1 : movement_.moving(placed.node);
    if (node < 0 || glm::determinant(glm::dmat3(placed.world)) == 0) return triangles_[material];
    moves_without_material_ = moves_without_material_ || material + 1 == triangles_.size();
    Mover& mover = movers_[{node, material}];
    mover.world = placed.world;
    return mover.triangles;
  }

  // After the draws that stand still.
  void add_moving_draws(const glm::dvec3& center) {
    glm::dmat4 to_world(1);
    to_world[3] = glm::dvec4(center, 1);
    for (const auto& [key, mover] : movers_) {
      if (mover.triangles.empty()) continue;
      scene_.draws.push_back(
          {static_cast<uint32_t>(scene_.indices.size()), static_cast<uint32_t>(mover.triangles.size()),
           static_cast<uint32_t>(key.second), static_cast<int>(scene_.draw_motions.size())});
      scene_.draw_motions.push_back(
          {static_cast<size_t>(key.first), glm::inverse(mover.world) * to_world, glm::vec3(0)});
      scene_.indices.insert(scene_.indices.end(), mover.triangles.begin(), mover.triangles.end());
    }
  }

  void note(size_t count, const std::string& what) {
    if (count) file_.notes.push_back(std::to_string(count) + " " + what);
  }

  void add_mesh(const PlacedNode& placed, const glm::dmat4& world, const std::vector<glm::dmat4>& joints) {
    auto mesh = static_cast<size_t>(file_.model.nodes[placed.node].mesh);
    const auto& primitives = file_.model.meshes[mesh].primitives;
    shared_.clear();
    for (size_t i = 0; i < primitives.size(); ++i) {
      const std::string where = at("meshes", mesh) + "." + at("primitives", i);
      if (!is_drawn(primitives[i])) continue;
      bool skinned = !joints.empty() && VertexTransforms::is_skinned(primitives[i]);
      add_primitive(
          placed, primitives[i], where,
          skinned ? VertexTransforms(file_, primitives[i], joints, where) : VertexTransforms(world));
    }
  }

  bool is_drawn(const tinygltf::Primitive& primitive) {
    bool triangles = primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES,
         positions = primitive.attributes.contains("POSITION");
    not_triangles_ += !triangles;
    without_positions_ += triangles && !positions;
    return triangles && positions;
  }

  void add_primitive(const PlacedNode& placed, const tinygltf::Primitive& primitive, const std::string& where,
                     const VertexTransforms& transforms) {
    int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    const VertexSource source(file_, primitive, where);
    size_t count = file_.model.accessors[source.positions].count;
    std::vector<uint32_t> corners = triangle_corners(primitive, mode, count, where);
    without_material_ += primitive.material < 0;
    without_coordinates_ += source.lacks_coordinates;
    size_t material =
        primitive.material < 0 ? triangles_.size() - 1 : static_cast<size_t>(primitive.material);
    std::vector<uint32_t>& list = triangles_of(placed, material, !transforms.is_one());
    check_capacity(source.normals < 0 ? corners.size() : count, corners.size(), where);

    // Mirrored triangles are turned over, so that their fronts stay fronts.
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
      if (glm::determinant(glm::dmat3(transforms.of(corners[i]))) < 0)
        std::swap(corners[i + 1], corners[i + 2]);
    if (source.normals >= 0) {
      uint32_t base = shared_vertices(placed, source, transforms);
      for (uint32_t corner : corners) list.push_back(base + corner);
    } else {
      add_flat(placed, source, transforms, corners, list);
    }
  }

  std::vector<uint32_t> triangle_corners(const tinygltf::Primitive& primitive, int mode, size_t vertices,
                                         const std::string& where) const {
    std::vector<uint32_t> corners;
    if (primitive.indices < 0) {
      if (vertices > max_vertices)
        file_.fail(where, "has " + std::to_string(vertices) + " vertices, more than the limit of " +
                              std::to_string(max_vertices));
      corners.resize(vertices);
      for (size_t i = 0; i < vertices; ++i) corners[i] = static_cast<uint32_t>(i);
    } else {
      corners = read_indices(file_, static_cast<size_t>(primitive.indices), where + ".indices");
      for (size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertices)
          file_.fail(where + ".indices", at("accessors", static_cast<size_t>(primitive.indices)) +
                                             " element " + std::to_string(i) + " is " +
                                             std::to_string(corners[i]) + ", but there are " +
                                             std::to_string(vertices) + " vertices");
    }
    return as_triangles(corners, mode);
  }

  // The same for all instances of a node, before the first of them is made.
  void check_instances(const PlacedNode& placed, size_t instances) const {
    auto mesh = static_cast<size_t>(file_.model.nodes[placed.node].mesh);
    size_t vertices = 0;
    for (const tinygltf::Primitive& primitive : file_.model.meshes[mesh].primitives)
      if (auto found = primitive.attributes.find("POSITION"); found != primitive.attributes.end())
        vertices += std::min(file_.model.accessors[static_cast<size_t>(found->second)].count, max_vertices);
    if (instances > 1 && vertices > (max_vertices - scene_.vertices.size()) / instances)
      file_.fail(at("nodes", placed.node), "with its " + std::to_string(instances) +
                                               " instances the scene has more than " +
                                               std::to_string(max_vertices) + " vertices");
  }

  // Before memory is asked for: one mesh may stand on very many nodes.
  void check_capacity(size_t vertices, size_t corners, const std::string& where) {
    corners_ += corners;
    if (scene_.vertices.size() + vertices > max_vertices || corners_ > max_indices)
      file_.fail(where, "the scene has more than " + std::to_string(max_vertices) + " vertices or triangles");
  }

  glm::dvec3 world_position(const PlacedNode& placed, const VertexSource& source, const glm::dmat4& transform,
                            const VertexAttributes& attributes, size_t i) const {
    const glm::dvec3 position(transform * glm::dvec4(attributes.positions[i], 1));
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(position[c]) <= max_coordinate))
        file_.fail(source.where, "on " + at("nodes", placed.node) + " its vertex " + std::to_string(i) +
                                     " lies more than 1e9 m from the origin");
    return position;
  }

  // The first of the vertices that all primitives of this node with the same attributes share.
  uint32_t shared_vertices(const PlacedNode& placed, const VertexSource& source,
                           const VertexTransforms& transforms) {
    std::vector<double> key = source.key();
    // Joints and weights are a primitive's own.
    if (auto found = shared_.find(key); transforms.is_one() && found != shared_.end()) return found->second;
    const VertexAttributes attributes(file_, source);
    auto base = static_cast<uint32_t>(scene_.vertices.size());
    for (size_t i = 0; i < attributes.positions.size(); ++i) {
      const glm::dmat4 transform = transforms.of(i);
      const glm::dmat3 linear(transform);
      add_vertex(world_position(placed, source, transform, attributes, i),
                 unit(normal_matrix(linear) * attributes.normals[i]), attributes, i);
      add_details(attributes, i, &linear, scene_);
    }
    if (transforms.is_one()) shared_.emplace(std::move(key), base);
    return base;
  }

  // glTF: a mesh without normals is drawn with flat ones, so that no two triangles share a vertex.
  void add_flat(const PlacedNode& placed, const VertexSource& source, const VertexTransforms& transforms,
                const std::vector<uint32_t>& corners, std::vector<uint32_t>& list) {
    const VertexAttributes attributes(file_, source);
    std::vector<glm::dvec3> positions;
    for (size_t i = 0; i < attributes.positions.size(); ++i)
      positions.push_back(world_position(placed, source, transforms.of(i), attributes, i));
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
      glm::dvec3 a = positions[corners[i]], b = positions[corners[i + 1]], c = positions[corners[i + 2]];
      glm::dvec3 normal = unit(glm::cross(b - a, c - a));
      for (size_t k = 0; k < 3; ++k) {
        list.push_back(static_cast<uint32_t>(scene_.vertices.size()));
        add_vertex(positions[corners[i + k]], normal, attributes, corners[i + k]);
        add_details(attributes, corners[i + k], nullptr, scene_);
      }
    }
  }

  void add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const VertexAttributes& attributes,
                  size_t i) {
    positions_.push_back(position);
    scene_.vertices.push_back(
        {glm::vec3(0), glm::vec3(normal), attributes.uvs[static_cast<size_t>(TextureSlot::base_color)][i]});
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

  File& file_;
  const Movement& movement_;
  Scene& scene_;
  std::map<std::pair<int, size_t>, Mover> movers_;  // by node of the motions and material
  bool moves_without_material_ = false;
  std::vector<glm::dvec3> positions_;               // m, in the file's world; beside scene_.vertices
  std::vector<std::vector<uint32_t>> triangles_;    // for each material
  std::map<std::vector<double>, uint32_t> shared_;  // by VertexSource::key()
  std::vector<glm::dmat4> worlds_;                  // of all nodes, once a skin asks for them
  size_t corners_ = 0;
  size_t not_triangles_ = 0, without_positions_ = 0, without_material_ = 0, without_coordinates_ = 0,
         hidden_ = 0;
};

}  // namespace

glm::dvec3 load_meshes(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                       const glm::dvec3* center, Scene& scene) {
  MeshLoader loader(file, movement, scene);
  for (const PlacedNode& node : nodes) loader.add_node(node);
  return loader.finish(center);
}

}  // namespace ml::gltf
