#include <algorithm>
#include <cmath>

#include "harness/gltf/parts.h"

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

std::vector<glm::dmat4> world_transforms(const File& file) {
  const std::vector<int> parents = check_tree(file);
  std::vector<glm::dmat4> worlds(parents.size(), glm::dmat4(1));
  std::vector<size_t> pending;
  for (size_t i = 0; i < parents.size(); ++i)
    if (parents[i] < 0) pending.push_back(i);
  while (!pending.empty()) {
    const size_t node = pending.back();
    pending.pop_back();
    const glm::dmat4 above = parents[node] < 0 ? glm::dmat4(1) : worlds[static_cast<size_t>(parents[node])];
    worlds[node] = above * local_transform(file, node);
    for (int child : file.model.nodes[node].children) pending.push_back(static_cast<size_t>(child));
  }
  return worlds;
}

namespace {

bool is_visible(const File& file, size_t node) {
  return file.json["nodes"][node].value("/extensions/KHR_node_visibility/visible"_json_pointer, true);
}

// A node that a scene lists, as its parents place it.
PlacedNode root_at(const File& file, const std::vector<int>& parents, size_t node) {
  PlacedNode root{node};
  for (int up = parents[node]; up >= 0; up = parents[static_cast<size_t>(up)]) {
    const auto above = static_cast<size_t>(up);
    root.world = local_transform(file, above) * root.world;
    root.visible = root.visible && is_visible(file, above);
  }
  return root;
}

}  // namespace

std::vector<PlacedNode> place_nodes(File& file, int scene_index) {
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
    for (int root : roots) listed[static_cast<size_t>(root)] = 1;
    size_t not_roots = 0;
    for (size_t i = roots.size(); i-- > 0;) {
      auto root = static_cast<size_t>(roots[i]);
      bool below = false;  // a node that is listed too, and brings this one along
      for (int up = parents[root]; up >= 0 && !below; up = parents[static_cast<size_t>(up)])
        below = listed[static_cast<size_t>(up)] != 0;
      const bool again = listed[root] == 2;
      not_roots += parents[root] >= 0 || again;
      if (below || again) continue;
      listed[root] = 2;
      pending.push_back(root_at(file, parents, root));
    }
    if (not_roots)
      file.notes.push_back(std::to_string(not_roots) +
                           " nodes that the scene lists lie below others or are listed twice; each is drawn "
                           "once, where its parents put it");
  }
  while (!pending.empty()) {
    PlacedNode next = pending.back();
    pending.pop_back();
    next.world = next.world * local_transform(file, next.node);
    next.visible = next.visible && is_visible(file, next.node);
    if (!all_finite(next.world)) file.fail(at("nodes", next.node), "its world transform is not finite");
    placed.push_back(next);
    const std::vector<int>& children = model.nodes[next.node].children;
    for (size_t i = children.size(); i-- > 0;)
      pending.push_back({static_cast<size_t>(children[i]), next.world, next.visible});
  }
  return placed;
}

}  // namespace ml::gltf
