#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

// A light without a range reaches, in glTF, infinitely far. It gets the distance at which its irradiance I /
// r^2 has fallen to this, which is 1 % of what 1 W/sr gives at 1 m. Not less where the level is small: the
// window would darken what lies well inside it.
constexpr double least_irradiance = 0.01;  // W/m^2
// m: a range beyond this reaches past any level, and stands for "infinite" (exporters write 3.4e38).
constexpr double max_range = max_coordinate;

LightShape shape_of(const std::string& type, const std::string& own) {
  if (own == "capsule") return LightShape::capsule;
  if (own == "wedge") return LightShape::wedge;
  if (own == "box") return LightShape::box;
  return type == "spot" ? LightShape::spot : LightShape::omni;
}

// glTF's candela and lux are taken as W/sr and W/m^2, one for one: the bench's pictures have no photometric
// scale.
Light light_of(const File& file, size_t index, size_t& without_range) {
  const tinygltf::Light& source = file.model.lights[index];
  const Json& json = file.json["extensions"]["KHR_lights_punctual"]["lights"][index];
  Light light;
  double peak = 0;
  for (int c = 0; c < 3; ++c) {
    double color = source.color.size() == 3 ? source.color[static_cast<size_t>(c)] : 1;
    light.intensity[c] = static_cast<float>(color * source.intensity);
    peak = std::max(peak, color * source.intensity);
  }
  const Json own = json.value("/extras/manylights"_json_pointer, Json::object());
  light.shape = shape_of(source.type, own.value("shape", ""));
  light.probe = own.value("probe", false);
  if (light.shape == LightShape::box) {
    make_box(light, {own["half_extents"][0].get<float>(), own["half_extents"][1].get<float>(),
                     own["half_extents"][2].get<float>()});
  } else if (json.contains("range") && source.range <= max_range) {
    light.radius = static_cast<float>(source.range);
  } else {
    ++without_range;
    light.radius = static_cast<float>(std::min(std::sqrt(peak / least_irradiance), max_range));
  }
  if (has_segment(light.shape)) light.half_length = own["half_length"].get<float>();
  if (!has_cone(light.shape)) return light;
  light.inner_angle = static_cast<float>(source.spot.innerConeAngle);
  light.outer_angle = json["spot"].contains("outerConeAngle") ? static_cast<float>(source.spot.outerConeAngle)
                                                              : light.outer_angle;
  if (own.contains("cone")) {
    light.inner_angle = own["cone"][0].get<float>();
    light.outer_angle = own["cone"][1].get<float>();
  }
  return light;
}

void load_side_file(const File& file, const std::string& name, Scene& scene) {
  static const std::string where = "asset.extras.manylights.lights";
  std::filesystem::path path = external_path(file, where, name);
  std::vector<std::byte> bytes;
  try {
    bytes = read_file(path);
  } catch (const UsageError& error) {
    file.fail(where, error.what());
  }
  std::vector<Light> lights = decode_lights(path.string(), bytes);
  scene.lights.insert(scene.lights.end(), lights.begin(), lights.end());
}

}  // namespace

void load_lights(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                 const glm::dvec3& center, Scene& scene) {
  size_t without_range = 0;
  uint32_t directional = 0, hidden = 0, without_scale = 0;
  const auto punctual = "/extensions/KHR_lights_punctual/light"_json_pointer;
  for (const PlacedNode& placed : nodes) {
    const Json& node = file.json["nodes"][placed.node];
    if (!node.contains(punctual)) continue;
    if (!placed.visible) {
      ++hidden;
      continue;
    }
    auto index = node[punctual].get<size_t>();
    if (file.model.lights[index].type == "directional") {
      ++directional;
      continue;
    }
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(placed.world[3][c]) <= max_coordinate))
        file.fail(at("nodes", placed.node), "its light lies more than 1e9 m from the origin");
    Light light = light_of(file, index, without_range);
    glm::dmat4 world = placed.world;
    world[3] -= glm::dvec4(center, 0);
    const int mover = movement.moving(placed.node);
    // A light whose node is animated may have a position later.
    if (!place_on_node(light, world)) {
      if (mover < 0) {
        ++without_scale;
        continue;
      }
      light.position = glm::dvec3(world[3]);
    }
    if (mover >= 0) {
      scene.light_nodes.resize(scene.lights.size(), -1);
      scene.light_nodes.push_back(mover);
    }
    scene.lights.push_back(light);
  }
  if (directional) {
    scene.rejected_lights["directional (a sun)"] = directional;
    file.notes.push_back(fmt::format(
        "{} directional light{} (a sun) {} not used: the bench's lights have a place and a radius",
        directional, directional == 1 ? "" : "s", directional == 1 ? "is" : "are"));
  }
  if (hidden) scene.rejected_lights["hidden (KHR_node_visibility)"] = hidden;
  if (without_scale) scene.rejected_lights["its node has scale 0"] = without_scale;
  if (without_range)
    file.notes.push_back(std::to_string(without_range) +
                         " lights have no range, and end where they give 0.01 W/m^2");
  if (std::string name = file.json.value("/asset/extras/manylights/lights"_json_pointer, ""); !name.empty())
    load_side_file(file, name, scene);
  if (!scene.light_nodes.empty()) scene.light_nodes.resize(scene.lights.size(), -1);
}

}  // namespace ml::gltf
