#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

constexpr double min_near = 1e-6, max_near = 1e6;  // m
constexpr float max_scene_near = 100;              // m, for views that are not a camera of the file
const auto window_key = "/extras/manylights/window"_json_pointer;
constexpr size_t max_name = 100;            // bytes, as many as a configuration's camera.path may have
constexpr uint32_t times_between_keys = 7;  // at which a moving camera's reach is measured
// Widens the farthest corner's distance, so that rounding never cuts it off.
constexpr double reach_margin = 1.001;

// What a configuration can hold: no control characters, at most max_name bytes, whole UTF-8 letters.
std::string typeable(const std::string& name, size_t max_bytes = max_name) {
  std::string result = name;
  if (result.size() > max_bytes) {
    size_t end = max_bytes;
    while (end > 0 && (static_cast<unsigned char>(result[end]) & 0xc0) == 0x80) --end;
    result.resize(end);
  }
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  return result;
}

// The name itself, or with the first number that nobody has yet, still typeable.
std::string unique(const std::string& name, std::set<std::string>& taken) {
  std::string result = name;
  for (int i = 2; !taken.insert(result).second; ++i) {
    const std::string number = "-" + std::to_string(i);
    result = typeable(name, max_name - number.size()) + number;
  }
  return result;
}

class CameraLoader {
 public:
  CameraLoader(File& file, const Movement& movement, const glm::dvec3& center, Scene& scene)
      : file_(file), movement_(movement), center_(center), scene_(scene) {}

  void add(const PlacedNode& placed) {
    CameraPath path;
    path.name = name_of(placed.node);
    const double reach = set_views(path, placed);
    path.reach = static_cast<float>(reach * reach_margin);
    set_lens(path, static_cast<size_t>(file_.model.nodes[placed.node].camera));
    scene_.paths.push_back(std::move(path));
  }

  void finish() {
    if (untypeable_)
      file_.notes.push_back(fmt::format(
          "{} cameras have names with control characters or more than {} bytes: they are called by what of "
          "them can be typed, with '_' for the rest",
          untypeable_, max_name));
    if (scene_.paths.empty()) return;
    // The first camera is found under its own name and as `default`.
    const bool is_default = scene_.paths[0].name == "default";
    std::set<std::string> names;
    if (!is_default) names.insert("default");
    for (CameraPath& path : scene_.paths) path.name = unique(path.name, names);
    if (!is_default) {
      scene_.paths.insert(scene_.paths.begin(), scene_.paths[0]);
      scene_.paths[0].name = "default";
    }
  }

 private:
  std::string name_of(size_t node) {
    const tinygltf::Node& source = file_.model.nodes[node];
    const std::string& own =
        source.name.empty() ? file_.model.cameras[static_cast<size_t>(source.camera)].name : source.name;
    if (own.empty()) return "camera-" + std::to_string(scene_.paths.size());
    std::string name = typeable(own);
    untypeable_ += name != own;
    return name;
  }

  void check_view(size_t node, const glm::dmat4& world) const {
    const glm::dvec3 back(world[2]), top(world[1]), position(world[3]);
    const double length = glm::length(back), top_length = glm::length(top);
    bool usable =
        std::isfinite(length) && length > 1e-150 && std::isfinite(top_length) && top_length > 1e-150;
    for (int c = 0; c < 3; ++c) usable = usable && std::abs(position[c]) <= max_coordinate;
    if (!usable) file_.fail(at("nodes", node), "its camera has no finite position and direction");
  }

  CameraKey key_of(const glm::dmat4& world, double time) const {
    const glm::dvec3 position = glm::dvec3(world[3]) - center_;
    return {time, position, position - glm::normalize(glm::dvec3(world[2])),
            glm::normalize(glm::dvec3(world[1]))};
  }

  // m, from the camera to the farthest corner of the level's bounds.
  double reach_from(const glm::dmat4& world) const {
    const glm::dvec3 eye = glm::dvec3(world[3]) - center_;
    const glm::dvec3 low(scene_.bounds.min), high(scene_.bounds.max);
    return glm::length(glm::max(glm::abs(low - eye), glm::abs(high - eye)));
  }

  // The path's views; returns the farthest that it reaches.
  double set_views(CameraPath& path, const PlacedNode& placed) const {
    const int index = movement_.of(placed.node);
    if (index < 0) {
      check_view(placed.node, placed.world);
      path.keys.push_back(key_of(placed.world, 0));
      return reach_from(placed.world);
    }
    const NodeMotions& motions = *movement_.motions;
    const auto carrier = static_cast<size_t>(index);
    double reach = 0;
    for (double time : sample_times(motions, carrier, times_between_keys)) {
      const glm::dmat4 world = motions.world(carrier, time);
      check_view(placed.node, world);
      reach = std::max(reach, reach_from(world));
    }
    path.carrier = CameraNode{movement_.motions, carrier, center_};
    for (double time : {motions.begin(), motions.end()})
      if (path.keys.empty() || time > path.keys.back().time)
        path.keys.push_back(key_of(motions.world(carrier, time), time));
    return reach;
  }

  void note(const CameraPath& path, const std::string& what) {
    file_.notes.push_back(fmt::format("camera '{}': {}", path.name, what));
  }

  // A near plane that the bench can work with, m.
  double near_of(const CameraPath& path, double given, double least) {
    const double near = std::clamp(given, least, max_near);
    if (near != given && given > 0)
      note(path, fmt::format("its znear of {:g} m is out of range, {:g} m is taken", given, near));
    return near;
  }

  void set_lens(CameraPath& path, size_t index) {
    const tinygltf::Camera& camera = file_.model.cameras[index];
    const Json& json = file_.json["cameras"][index];
    const std::string where = at("cameras", index);
    if (camera.type == "perspective")
      set_perspective(path, camera.perspective,
                      json["perspective"].contains("zfar") && !json.contains(window_key));
    else
      set_orthographic(path, camera.orthographic, where);
    read_window(path, json, where);
    if (scene_.paths.empty())
      scene_.near = std::min(path.has_projection ? path.projection.near : path.own_near, max_scene_near);
  }

  void set_perspective(CameraPath& path, const tinygltf::PerspectiveCamera& lens, bool has_far) {
    path.vertical_fov = static_cast<float>(lens.yfov);
    path.own_near = static_cast<float>(near_of(path, lens.znear, min_near));
    if (!has_far || lens.zfar >= double{path.reach}) return;  // nothing lies beyond
    if (!(lens.zfar > double{path.own_near})) {
      note(path, fmt::format("its zfar of {:g} m is not beyond its znear of {:g} m, and cuts nothing",
                             lens.zfar, path.own_near));
      return;
    }
    path.own_far = static_cast<float>(lens.zfar);
    path.clips_far = path.own_far > path.own_near;
    if (path.clips_far)
      note(path, fmt::format("what is farther than its zfar of {:g} m is not seen", lens.zfar));
  }

  void set_orthographic(CameraPath& path, const tinygltf::OrthographicCamera& lens,
                        const std::string& where) {
    auto width = static_cast<float>(std::abs(lens.xmag)), height = static_cast<float>(std::abs(lens.ymag));
    if (!(width > 0 && height > 0 && width <= 1e9f && height <= 1e9f))
      file_.fail(where + ".orthographic", "expected an xmag and ymag that are not 0");
    path.has_projection = true;
    path.projection.kind = ProjectionKind::orthographic;
    path.projection.left = -width, path.projection.right = width;
    path.projection.bottom = -height, path.projection.top = height;
    // The bench's near plane lies in front of the camera: a millimetre, or less in a level of millimetres.
    const double least = std::clamp(1e-4 * double{path.reach}, min_near, 0.001);
    const double near = near_of(path, lens.znear, least);
    if (!(lens.zfar > near)) file_.fail(where + ".orthographic.zfar", "expected more than znear");
    path.projection.near = static_cast<float>(near);
    path.projection.far = std::max(static_cast<float>(std::min(lens.zfar, max_coordinate)),
                                   std::nextafter(path.projection.near, 1e10f));
  }

  // An asymmetric window, as the bench's exporter keeps it beside the symmetric one that glTF knows. Its far
  // bounds the grids of algorithms and clips nothing: the exporter writes the projection of a procedural
  // path.
  void read_window(CameraPath& path, const Json& camera, const std::string& where) {
    Json window = camera.value(window_key, Json());
    if (window.is_null()) return;
    Projection& projection = path.projection;
    float* sides[] = {&projection.left, &projection.right, &projection.bottom, &projection.top};
    for (size_t i = 0; i < 4; ++i) *sides[i] = window[i].get<float>();
    bool usable = projection.left < projection.right && projection.bottom < projection.top;
    for (float* side : sides) usable = usable && std::abs(*side) <= 1e9f;
    if (!usable) file_.fail(where + ".extras.manylights.window", "expected left < right and bottom < top");
    if (camera["type"] == "perspective") {
      path.projection.near = path.own_near;
      path.projection.far = static_cast<float>(
          std::clamp(camera["perspective"].value("zfar", 1000.0), min_near, max_coordinate));
      if (!(path.projection.far > path.projection.near)) path.projection.far = 2 * path.projection.near;
    }
    path.has_projection = true;
  }

  File& file_;
  const Movement& movement_;
  glm::dvec3 center_;
  Scene& scene_;
  size_t untypeable_ = 0;
};

}  // namespace

void load_cameras(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                  const glm::dvec3& center, Scene& scene) {
  CameraLoader loader(file, movement, center, scene);
  for (const PlacedNode& placed : nodes)
    if (file.model.nodes[placed.node].camera >= 0) loader.add(placed);
  loader.finish();
}

}  // namespace ml::gltf
