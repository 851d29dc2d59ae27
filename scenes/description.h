// scenes/NAME/scene.json: what is known of a scene without making it. README.md has the format.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/mesh_builder.h"
#include "harness/scene/scene.h"
#include "scenes/wanted.h"

namespace ml {

// A point of a camera path: [x, y, z], or {"x", "z", "above_ground"}.
struct PathPoint {
  glm::dvec3 coordinates{0};  // m
  bool above_ground = false;  // y counts from the ground below, which may differ by the seed
};

struct PathKey {
  double time = 0;  // s
  PathPoint position, target;
};

struct PathDescription {
  std::string name;
  std::vector<PathKey> keys;  // at least one, times increase
};

struct SceneDescription {
  std::string name;     // of its folder
  std::string summary;  // one line
  float near = 0, far = 0;
  LightDefaults lights;
  std::vector<PathDescription> paths;  // the first is `default`
  Wanted wanted;
};

// Throws UsageError "scenes/NAME/scene.json: PLACE: what".
SceneDescription read_description(const std::string& name, std::string_view json);

using GroundHeight = std::function<double(double x, double z)>;  // m

// All paths. Throws std::logic_error where one has points above a ground and there is none.
std::vector<CameraPath> camera_paths(const SceneDescription& description, const GroundHeight& ground = {});

// The level of all that was built.
Scene finish_level(MeshBuilder& mesh, const SceneDescription& description, std::vector<CameraPath> paths);

}  // namespace ml
