// Where the vertices of a mesh go: with its node, once for each of the node's instances, or by the joints of
// a skin. Private to the importer.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/gltf/parts.h"

namespace ml::gltf {

// The world transform of each of the node's instances (EXT_mesh_gpu_instancing); of the node alone where it
// has none.
std::vector<glm::dmat4> instance_transforms(const File& file, const PlacedNode& placed);

// A skin at rest: what takes each joint's vertices from the mesh into the world, joints where their nodes
// are.
std::vector<glm::dmat4> joint_matrices(const File& file, size_t skin, const std::vector<glm::dmat4>& worlds);

// One transform for all vertices of a primitive, or one for each.
class VertexTransforms {
 public:
  explicit VertexTransforms(const glm::dmat4& world) : world_(world) {}
  // By all sets of JOINTS_n and WEIGHTS_n that the primitive has; it has at least one (is_skinned). Weights
  // are brought to the sum 1; a vertex without any goes with its first joint.
  VertexTransforms(const File& file, const tinygltf::Primitive& primitive,
                   std::vector<glm::dmat4> joint_matrices, const std::string& where);
  static bool is_skinned(const tinygltf::Primitive& primitive);

  glm::dmat4 of(size_t vertex) const;
  bool is_one() const { return sets_.empty(); }

 private:
  struct Set {
    std::vector<double> joints, weights;  // four a vertex
  };
  glm::dmat4 world_{1};
  std::vector<glm::dmat4> matrices_;
  std::vector<Set> sets_;
};

}  // namespace ml::gltf
