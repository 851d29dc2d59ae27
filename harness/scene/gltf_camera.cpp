#include <algorithm>
#include <cmath>
#include <set>

#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

constexpr double key_turn =
    0.0875;  // 5 degrees, as the chord of the unit circle: the most between two keys of a path
constexpr double key_interval =
    0.1;  // s: the most between two keys, so that the spline follows straight lines
constexpr int most_per_interval = 64;
constexpr size_t max_path_keys = 200000;

struct View {
  glm::dvec3 position, forward;
  bool rolled;
};

class CameraLoader {
 public:
  CameraLoader(File& file, const glm::dvec3& center, Scene& scene)
      : file_(file), parents_(check_tree(file)), center_(center), scene_(scene) {}

  void add(size_t node) {
    std::vector<NodeMotion> chain;  // from the camera up to the root
    for (int up = static_cast<int>(node); up >= 0; up = parents_[static_cast<size_t>(up)])
      chain.emplace_back(file_, static_cast<size_t>(up));
    CameraPath path;
    path.name = name_of(node);
    path.keys = keys_of(node, chain);
    set_lens(path, static_cast<size_t>(file_.model.nodes[node].camera));
    scene_.paths.push_back(std::move(path));
  }

  void finish() {
    if (scene_.paths.empty()) return;
    std::set<std::string> names;
    for (CameraPath& path : scene_.paths) {
      std::string name = path.name;
      for (int i = 2; !names.insert(path.name).second; ++i) path.name = name + "-" + std::to_string(i);
    }
    // The first camera is found under its own name and as `default`.
    if (scene_.paths[0].name != "default") {
      for (size_t i = 1; i < scene_.paths.size(); ++i)
        if (scene_.paths[i].name == "default") scene_.paths[i].name = "default-2";
      scene_.paths.insert(scene_.paths.begin(), scene_.paths[0]);
      scene_.paths[0].name = "default";
    }
    if (rolled_)
      file_.notes.push_back(std::to_string(rolled_) +
                            " cameras are rolled about their axis, which is ignored");
  }

 private:
  std::string name_of(size_t node) const {
    const tinygltf::Node& source = file_.model.nodes[node];
    if (!source.name.empty()) return source.name;
    const std::string& name = file_.model.cameras[static_cast<size_t>(source.camera)].name;
    return name.empty() ? "camera-" + std::to_string(scene_.paths.size()) : name;
  }

  View view_at(size_t node, const std::vector<NodeMotion>& chain, double time) const {
    glm::dmat4 world(1);
    for (const NodeMotion& motion : chain) world = motion.at(time) * world;
    glm::dvec3 back(world[2]), side(world[0]), position(world[3]);
    double length = glm::length(back), side_length = glm::length(side);
    bool usable =
        std::isfinite(length) && length > 1e-150 && std::isfinite(side_length) && side_length > 1e-150;
    for (int c = 0; c < 3; ++c) usable = usable && std::abs(position[c]) <= max_coordinate;
    if (!usable) file_.fail(at("nodes", node), "its camera has no finite position and direction");
    View view{position - center_, -back / length, false};
    // A level camera's right is horizontal, unless it looks straight up or down.
    view.rolled = std::abs(side.y / side_length) > 1e-3 && std::abs(view.forward.y) < 0.9999;
    return view;
  }

  std::vector<CameraKey> keys_of(size_t node, const std::vector<NodeMotion>& chain) {
    std::vector<double> times;
    bool curved = false;
    for (const NodeMotion& motion : chain) motion.add_times(times, curved);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.empty()) times.push_back(0);

    std::vector<CameraKey> keys;
    bool rolled = false;
    auto add_key = [&](double time) {
      View view = view_at(node, chain, time);
      rolled = rolled || view.rolled;
      keys.push_back({time, view.position, view.position + view.forward});
      if (keys.size() > max_path_keys)
        file_.fail(at("nodes", node), "its camera moves through more than 200000 keys");
    };
    for (size_t i = 0; i < times.size(); ++i) {
      if (i > 0) {
        double begin = times[i - 1], span = times[i] - begin;
        double chord =
            glm::length(view_at(node, chain, begin).forward - view_at(node, chain, times[i]).forward);
        double parts = std::max(
            {std::ceil(chord / key_turn), std::ceil(span / key_interval - 1e-3), curved ? 8.0 : 1.0});
        int count = static_cast<int>(std::min(parts, double{most_per_interval}));
        for (int k = 1; k < count; ++k)
          if (double time = begin + span * k / count; time > keys.back().time && time < times[i])
            add_key(time);
      }
      add_key(times[i]);
    }
    rolled_ += rolled;
    return keys;
  }

  void set_lens(CameraPath& path, size_t index) {
    const tinygltf::Camera& camera = file_.model.cameras[index];
    const Json& json = file_.json["cameras"][index];
    std::string place = at("cameras", index);
    double near = 0;
    if (camera.type == "perspective") {
      path.vertical_fov = static_cast<float>(camera.perspective.yfov);
      near = camera.perspective.znear;
    } else {
      const auto& lens = camera.orthographic;
      auto width = static_cast<float>(std::abs(lens.xmag)), height = static_cast<float>(std::abs(lens.ymag));
      if (!(width > 0 && height > 0 && width <= 1e9f && height <= 1e9f))
        file_.fail(place + ".orthographic", "expected an xmag and ymag that are not 0");
      path.has_projection = true;
      path.projection.kind = ProjectionKind::orthographic;
      path.projection.left = -width, path.projection.right = width;
      path.projection.bottom = -height, path.projection.top = height;
      near = std::max(lens.znear, 0.001);  // the bench's near plane lies in front of the camera
      if (!(lens.zfar > near && lens.zfar <= max_coordinate))
        file_.fail(place + ".orthographic.zfar", "expected more than znear");
      path.projection.near = static_cast<float>(near);
      path.projection.far =
          std::max(static_cast<float>(lens.zfar), std::nextafter(path.projection.near, 1e10f));
    }
    read_window(path, json, place);
    if (scene_.paths.empty() && near >= 1e-4 && near <= 100) scene_.near = static_cast<float>(near);
  }

  // An asymmetric window, as the bench's exporter keeps it beside the symmetric one that glTF knows.
  void read_window(CameraPath& path, const Json& camera, const std::string& place) {
    Json window = camera.value("/extras/manylights/window"_json_pointer, Json());
    if (window.is_null()) return;
    Projection& projection = path.projection;
    float* sides[] = {&projection.left, &projection.right, &projection.bottom, &projection.top};
    for (size_t i = 0; i < 4; ++i) *sides[i] = window[i].get<float>();
    bool usable = projection.left < projection.right && projection.bottom < projection.top;
    for (float* side : sides) usable = usable && std::abs(*side) <= 1e9f;
    if (!usable) file_.fail(place + ".extras.manylights.window", "expected left < right and bottom < top");
    if (camera["type"] == "perspective") {
      path.projection.near =
          static_cast<float>(std::clamp(camera["perspective"]["znear"].get<double>(), 1e-6, 1e6));
      path.projection.far =
          static_cast<float>(std::clamp(camera["perspective"].value("zfar", 1000.0), 1e-6, max_coordinate));
      if (!(path.projection.far > path.projection.near)) path.projection.far = 2 * path.projection.near;
    }
    path.has_projection = true;
  }

  File& file_;
  std::vector<int> parents_;
  glm::dvec3 center_;
  Scene& scene_;
  size_t rolled_ = 0;
};

}  // namespace

void load_cameras(File& file, const std::vector<PlacedNode>& nodes, const glm::dvec3& center, Scene& scene) {
  CameraLoader loader(file, center, scene);
  for (const PlacedNode& placed : nodes)
    if (file.model.nodes[placed.node].camera >= 0) loader.add(placed.node);
  loader.finish();
}

}  // namespace ml::gltf
