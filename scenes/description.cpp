#include "scenes/description.h"

#include <algorithm>
#include <stdexcept>

#include "harness/base/json_node.h"
#include "harness/base/json_text.h"
#include "harness/lights/set.h"
#include "scenes/members.h"

namespace ml {
namespace {

constexpr double kFarthest = 1e6;   // m, any coordinate or length
constexpr double kLongest = 86400;  // s
constexpr size_t kMaxPaths = 100, kMaxKeys = 10000;

std::string file_of(const std::string& scene) {
  return "scenes/" + scene + "/scene.json";
}

// A length in metres that may be absent: 0.
double read_length(Members& members, const std::string& key) {
  auto node = members.find(key);
  return node ? node->real(0, kFarthest) : 0;
}

LightDefaults read_lights(const Node& node) {
  Members members(node);
  LightDefaults lights;
  lights.placement = static_cast<Placement>(members.get("placement").choice(placement_names()));
  if (auto fixed = members.find("fixed_placement")) lights.fixed_placement = fixed->boolean();
  if (auto ratio = members.find("radius_ratio"))
    lights.radius_ratio = static_cast<float>(ratio->real(0, 1000));
  lights.volume_size = read_length(members, "volume_size");
  lights.triangle_size = read_length(members, "triangle_size");
  lights.area_size = read_length(members, "area_size");
  lights.radius = static_cast<float>(read_length(members, "radius"));
  lights.height = static_cast<float>(read_length(members, "height"));
  if (auto script = members.find("animate"))
    lights.script = static_cast<LightScript>(script->choice(light_script_names()));
  members.expect_no_others();
  return lights;
}

PathPoint read_point(const Node& node) {
  auto coordinate = [](const Node& of) { return of.real(-kFarthest, kFarthest); };
  if (node.json().is_array()) {
    node.list(3, 3);
    return {{coordinate(node.item(0)), coordinate(node.item(1)), coordinate(node.item(2))}, false};
  }
  if (!node.json().is_object()) node.expected("[x, y, z] or an object with x, z and above_ground");
  Members members(node);
  PathPoint point{glm::dvec3(0), true};
  point.coordinates.x = coordinate(members.get("x"));
  point.coordinates.z = coordinate(members.get("z"));
  point.coordinates.y = coordinate(members.get("above_ground"));
  members.expect_no_others();
  return point;
}

PathDescription read_path(const Node& node) {
  Members members(node);
  PathDescription path;
  path.name = members.get("name").text(1, 100);
  const Node keys = members.get("keys");
  const size_t count = keys.list(1, kMaxKeys);
  for (size_t i = 0; i < count; ++i) {
    const Node item = keys.item(i);
    Members key(item);
    const Node time = key.get("time");
    path.keys.push_back(
        {time.real(0, kLongest), read_point(key.get("position")), read_point(key.get("target"))});
    if (i > 0 && path.keys[i].time <= path.keys[i - 1].time)
      time.fail("times of a path increase from key to key");
    key.expect_no_others();
  }
  members.expect_no_others();
  return path;
}

std::vector<PathDescription> read_paths(const Node& node) {
  std::vector<PathDescription> paths;
  const size_t count = node.list(1, kMaxPaths);
  for (size_t i = 0; i < count; ++i) {
    PathDescription path = read_path(node.item(i));
    const Node name = node.item(i).member("name");
    if (i == 0 && path.name != "default") name.expected("'default' of the first path");
    if (std::any_of(paths.begin(), paths.end(), [&](const auto& other) { return other.name == path.name; }))
      name.fail("there is a path of that name before");
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace

SceneDescription read_description(const std::string& name, std::string_view json) {
  const Source source{file_of(name), {}};
  const nlohmann::json document = parse_json_text(json, source.name);
  Members members(Node(document, source));
  SceneDescription description;
  description.name = name;
  description.summary = members.get("summary").text(1, 200);
  description.near = static_cast<float>(members.get("near").real(1e-3, kFarthest));
  const Node far = members.get("far");
  description.far = static_cast<float>(far.real(1e-3, kFarthest));
  if (description.far <= description.near) far.fail("the far plane lies before the near one");
  description.lights = read_lights(members.get("lights"));
  description.paths = read_paths(members.get("paths"));
  description.wanted = read_wanted(members.get("wanted"));
  members.expect_no_others();
  return description;
}

std::vector<CameraPath> camera_paths(const SceneDescription& description, const GroundHeight& ground) {
  auto placed = [&](const PathPoint& point) {
    if (!point.above_ground) return point.coordinates;
    if (!ground)
      throw std::logic_error(file_of(description.name) + ": a path is above the ground, and there is none");
    return glm::dvec3(point.coordinates.x,
                      ground(point.coordinates.x, point.coordinates.z) + point.coordinates.y,
                      point.coordinates.z);
  };
  std::vector<CameraPath> paths;
  for (const PathDescription& described : description.paths) {
    CameraPath path;
    path.name = described.name;
    for (const PathKey& key : described.keys)
      path.keys.push_back({key.time, placed(key.position), placed(key.target)});
    paths.push_back(std::move(path));
  }
  return paths;
}

Scene finish_level(MeshBuilder& mesh, const SceneDescription& description, std::vector<CameraPath> paths) {
  Scene scene = mesh.finish();
  scene.name = description.name;
  scene.light_defaults = description.lights;
  scene.near = description.near;
  scene.far = description.far;
  scene.paths = std::move(paths);
  return scene;
}

}  // namespace ml
