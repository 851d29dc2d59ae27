#include "harness/gltf/placement.h"

#include <cmath>

namespace ml::gltf {
namespace {

constexpr size_t max_instances = size_t{1} << 20;
constexpr int max_sets = 8;  // of JOINTS_n and WEIGHTS_n, as the schema lets through

bool is_finite(const glm::dmat4& matrix) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(matrix[c][r])) return false;
  return true;
}

}  // namespace

std::vector<glm::dmat4> instance_transforms(const File& file, const PlacedNode& placed) {
  const Json& node = file.json["nodes"][placed.node];
  const Json attributes =
      node.value("/extensions/EXT_mesh_gpu_instancing/attributes"_json_pointer, Json::object());
  const std::string where = at("nodes", placed.node) + ".extensions.EXT_mesh_gpu_instancing.attributes";
  size_t count = 0;
  auto read = [&](const char* name, int components) {
    if (!attributes.contains(name)) return std::vector<double>();
    std::vector<double> values =
        read_numbers(file, attributes[name].get<size_t>(), components, where + "." + name);
    if (values.size() / static_cast<size_t>(components) > max_instances)
      file.fail(where + "." + name, "has more than " + std::to_string(max_instances) + " elements");
    const size_t found = values.size() / static_cast<size_t>(components);
    if (count != 0 && found != count)
      file.fail(where + "." + name,
                "has " + std::to_string(found) + " elements, but others have " + std::to_string(count));
    count = found;
    return values;
  };
  const std::vector<double> translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
                            scales = read("SCALE", 3);
  if (count == 0) return {placed.world};

  std::vector<glm::dmat4> worlds;
  worlds.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Pose pose;
    if (!translations.empty())
      pose.translation = {translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]};
    if (!scales.empty()) pose.scale = {scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
    if (!rotations.empty()) {
      pose.rotation = {rotations[4 * i], rotations[4 * i + 1], rotations[4 * i + 2], rotations[4 * i + 3]};
      const double length = glm::length(pose.rotation);
      if (!(length > 1e-6 && length < 1e6))
        file.fail(where + ".ROTATION", "element " + std::to_string(i) + " is no unit quaternion");
      pose.rotation /= length;
    }
    worlds.push_back(placed.world * matrix_of(pose));
    if (!is_finite(worlds.back()))
      file.fail(where, "the transform of instance " + std::to_string(i) + " is not finite");
  }
  return worlds;
}

std::vector<glm::dmat4> joint_matrices(const File& file, size_t skin, const std::vector<glm::dmat4>& worlds) {
  const Json& json = file.json["skins"][skin];
  const Json& joints = json["joints"];
  const std::string where = at("skins", skin);
  std::vector<glm::dmat4> inverses(joints.size(), glm::dmat4(1));
  if (json.contains("inverseBindMatrices")) {
    const std::vector<double> values =
        read_numbers(file, json["inverseBindMatrices"].get<size_t>(), 16, where + ".inverseBindMatrices");
    if (values.size() / 16 < joints.size())
      file.fail(where + ".inverseBindMatrices", "has " + std::to_string(values.size() / 16) +
                                                    " elements, but there are " +
                                                    std::to_string(joints.size()) + " joints");
    for (size_t i = 0; i < joints.size(); ++i)
      for (int k = 0; k < 16; ++k) inverses[i][k / 4][k % 4] = values[16 * i + static_cast<size_t>(k)];
  }
  for (size_t i = 0; i < joints.size(); ++i) {
    inverses[i] = worlds[joints[i].get<size_t>()] * inverses[i];
    if (!is_finite(inverses[i])) file.fail(where + "." + at("joints", i), "its transform is not finite");
  }
  return inverses;
}

bool VertexTransforms::is_skinned(const tinygltf::Primitive& primitive) {
  return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
}

VertexTransforms::VertexTransforms(const File& file, const tinygltf::Primitive& primitive,
                                   std::vector<glm::dmat4> joint_matrices, const std::string& where)
    : matrices_(std::move(joint_matrices)) {
  const size_t vertices =
      file.model.accessors[static_cast<size_t>(primitive.attributes.at("POSITION"))].count;
  for (int n = 0; n < max_sets; ++n) {
    const std::string joints = "JOINTS_" + std::to_string(n), weights = "WEIGHTS_" + std::to_string(n);
    if (!primitive.attributes.contains(joints) || !primitive.attributes.contains(weights)) break;
    auto read = [&](const std::string& name) {
      const std::string attribute = where + ".attributes." + name;
      std::vector<double> values =
          read_numbers(file, static_cast<size_t>(primitive.attributes.at(name)), 4, attribute);
      if (values.size() / 4 != vertices)
        file.fail(attribute, "has " + std::to_string(values.size() / 4) + " elements, but there are " +
                                 std::to_string(vertices) + " positions");
      return values;
    };
    sets_.push_back({read(joints), read(weights)});
    const Set& set = sets_.back();
    for (size_t i = 0; i < set.joints.size(); ++i) {
      // Slots without weight may hold anything, but for the first, which stands in where no slot has weight.
      if (set.weights[i] == 0 && i % 4 != 0) continue;
      const double joint = set.joints[i];
      if (!(joint >= 0 && joint < static_cast<double>(matrices_.size()) && joint == std::floor(joint)))
        file.fail(where + ".attributes." + joints,
                  "vertex " + std::to_string(i / 4) +
                      " hangs on a joint that its skin does not have; it has " +
                      std::to_string(matrices_.size()));
    }
  }
}

glm::dmat4 VertexTransforms::of(size_t vertex) const {
  if (is_one()) return world_;
  glm::dmat4 sum(0);
  double total = 0;
  for (const Set& set : sets_)
    for (size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
      if (set.weights[i] == 0) continue;
      sum += set.weights[i] * matrices_[static_cast<size_t>(set.joints[i])];
      total += set.weights[i];
    }
  if (!(std::abs(total) > 1e-9)) return matrices_[static_cast<size_t>(sets_[0].joints[4 * vertex])];
  return sum * (1 / total);
}

}  // namespace ml::gltf
