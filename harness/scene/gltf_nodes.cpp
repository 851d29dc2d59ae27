#include <algorithm>
#include <cmath>

#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

bool all_finite(const glm::dmat4& matrix) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(matrix[c][r])) return false;
  return true;
}

}  // namespace

Pose local_pose(const File& file, size_t index) {
  const tinygltf::Node& node = file.model.nodes[index];
  Pose pose;
  if (node.translation.size() == 3)
    pose.translation = {node.translation[0], node.translation[1], node.translation[2]};
  if (node.scale.size() == 3) pose.scale = {node.scale[0], node.scale[1], node.scale[2]};
  if (node.rotation.size() == 4) {
    pose.rotation = {node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]};
    double length = glm::length(pose.rotation);
    if (!(length > 1e-6 && length < 1e6))
      file.fail(at("nodes", index) + ".rotation", "expected a unit quaternion");
    pose.rotation /= length;
  }
  return pose;
}

glm::dmat4 local_transform(const File& file, size_t index) {
  const tinygltf::Node& node = file.model.nodes[index];
  if (node.matrix.size() != 16) return matrix_of(local_pose(file, index));
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    file.fail(at("nodes", index) + ".matrix", "expected 0 0 0 1 as its last row");
  return m;
}

std::vector<int> check_tree(const File& file) {
  const auto& nodes = file.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (size_t i = 0; i < nodes.size(); ++i)
    for (int child : nodes[i].children) {
      int& parent = parents[static_cast<size_t>(child)];
      if (parent >= 0)
        file.fail(at("nodes", static_cast<size_t>(child)),
                  "has two parents, " + at("nodes", static_cast<size_t>(parent)) + " and " + at("nodes", i));
      parent = static_cast<int>(i);
    }
  // With one parent each, a node that is not below a root can only be on or below a cycle.
  std::vector<size_t> level;
  std::vector<char> reached(nodes.size(), 0);
  for (size_t i = 0; i < nodes.size(); ++i)
    if (parents[i] < 0) level.push_back(i);
  for (int depth = 1; !level.empty(); ++depth) {
    if (depth > max_depth)
      file.fail(at("nodes", level[0]), "lies more than " + std::to_string(max_depth) + " levels deep");
    std::vector<size_t> below;
    for (size_t node : level) {
      reached[node] = 1;
      below.insert(below.end(), nodes[node].children.begin(), nodes[node].children.end());
    }
    level.swap(below);
  }
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (reached[i]) continue;
    // Going up as often as there are nodes ends on the cycle itself.
    size_t node = i;
    for (size_t step = 0; step < nodes.size(); ++step) node = static_cast<size_t>(parents[node]);
    file.fail(at("nodes", node), "is its own ancestor");
  }
  return parents;
}

std::vector<PlacedNode> place_nodes(const File& file, int scene_index) {
  const tinygltf::Model& model = file.model;
  std::vector<int> parents = check_tree(file);
  std::vector<PlacedNode> placed;
  std::vector<PlacedNode> pending;  // a stack: children are put on it in reverse

  if (model.scenes.empty()) {
    if (scene_index > 0)
      file.fail("scenes", "scene " + std::to_string(scene_index) + " is wanted, but the file has none");
    for (size_t i = model.nodes.size(); i-- > 0;)
      if (parents[i] < 0) pending.push_back({i});
  } else {
    int wanted = scene_index >= 0 ? scene_index : std::max(model.defaultScene, 0);
    if (static_cast<size_t>(wanted) >= model.scenes.size())
      file.fail("scenes", "scene " + std::to_string(wanted) + " is wanted, but the file has " +
                              std::to_string(model.scenes.size()));
    const std::vector<int>& roots = model.scenes[static_cast<size_t>(wanted)].nodes;
    std::vector<char> listed(model.nodes.size(), 0);
    for (size_t i = roots.size(); i-- > 0;) {
      auto root = static_cast<size_t>(roots[i]);
      std::string place = at("scenes", static_cast<size_t>(wanted)) + "." + at("nodes", i);
      if (parents[root] >= 0) file.fail(place, at("nodes", root) + " is not a root");
      if (listed[root]) file.fail(place, at("nodes", root) + " is listed twice");
      listed[root] = 1;
      pending.push_back({root});
    }
  }
  while (!pending.empty()) {
    PlacedNode next = pending.back();
    pending.pop_back();
    next.world = next.world * local_transform(file, next.node);
    if (!all_finite(next.world)) file.fail(at("nodes", next.node), "its world transform is not finite");
    placed.push_back(next);
    const std::vector<int>& children = model.nodes[next.node].children;
    for (size_t i = children.size(); i-- > 0;)
      pending.push_back({static_cast<size_t>(children[i]), next.world});
  }
  return placed;
}

}  // namespace ml::gltf
