// Cameras: where the picture is taken from and how view space maps to pixels.
//
// View space: x right, y up, z forward (depth is positive in front), metres. Perspective pixels are slopes
// (x/z, y/z); orthographic pixels are metres (x, y). Row 0 of a picture is at the top.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/scene/node_motion.h"

namespace ml {

enum class ProjectionKind : uint32_t { perspective = 0, orthographic = 1 };

// The window of the picture in view space. Off-centre, jittered and asymmetric windows are allowed: nothing
// may assume left == -right.
struct Projection {
  ProjectionKind kind = ProjectionKind::perspective;
  float left = -1, right = 1;  // slopes at z = 1 m, or metres; left < right
  float bottom = -1, top = 1;  // bottom < top
  float near = 0.1f;           // m, > 0; surfaces nearer than this are clipped
  // m, > near. Perspective depth is reversed and infinite (1 at near, 0 at infinity): `far` bounds the depth
  // grids of algorithms (their last slice takes what lies beyond), and clips where `clips_far` says so.
  // Orthographic depth is reversed and linear, clipped at far.
  float far = 1000;
  bool clips_far = false;  // surfaces beyond `far` are not seen

  // `vertical_fov` in radians, (0, pi).
  static Projection perspective(float vertical_fov, float aspect, float near, float far);
  static Projection orthographic(float half_width, float half_height, float near, float far);
};

// A camera in the scene, rotation as an orthonormal right-handed basis (right x up = -forward).
struct Camera {
  // m, relative to Scene::origin. Rounded to float on purpose: vertices and lights are made camera-relative
  // with exactly this value.
  glm::vec3 position{0};
  glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  Projection projection;

  // Looks from `position` to `target`; straight up and straight down are allowed. The picture's top lies
  // towards `up`, which need not be at right angles to the view; where that says nothing (0, or along the
  // view) the horizon is level. Throws nothing; position == target looks along -z.
  static Camera look_at(const glm::dvec3& position, const glm::dvec3& target, const Projection& projection,
                        const glm::dvec3& up = glm::dvec3(0));
  // The camera of a glTF node: looks along its -z, its y is up. A camera is rigid: scale, shear and
  // reflection leave it alone. `world` relative to the scene's origin.
  static Camera of_node(const glm::dmat4& world, const Projection& projection);
};

// One point of a camera path.
struct CameraKey {
  double time = 0;  // s, strictly increasing along a path
  glm::dvec3 position{0};
  glm::dvec3 target{0, 0, -1};
  glm::dvec3 up{0};  // of a camera that stands still: Camera::look_at; 0: a level horizon
};

// A camera that a node of a level carries: exactly the node's view, cuts and roll included.
struct CameraNode {
  std::shared_ptr<const NodeMotions> motions;
  size_t node = 0;
  glm::dvec3 center{0};  // m, the scene's origin in the file's world
};

// A Catmull-Rom spline (centripetal-free, uniform in its own time) through the keys: position and target
// alike.
struct CameraPath {
  std::string name;
  std::vector<CameraKey> keys;  // at least one; one key is a camera that stands still
  // Where this is set, it is the path: the keys are the first and the last view and its times.
  std::optional<CameraNode> carrier;
  float vertical_fov = 1.0471976f;  // radians (60 degrees)
  // When set, the projection of a file's own camera is used as it is (its aspect ratio stretched to the
  // picture's height).
  bool has_projection = false;
  Projection projection;
  // m, of a perspective camera without a projection of its own; 0: the scene's.
  float own_near = 0, own_far = 0;
  bool clips_far = false;
  // m, from the camera to the level's farthest corner, a little more: an orthographic far plane is taken no
  // farther, where depths would lose their digits; 0: not known.
  float reach = 0;

  double duration() const { return keys.empty() ? 0 : keys.back().time - keys.front().time; }
  // The camera of frame `frame` of `frames` (frame 0 at the first key, frame frames-1 at the last), for a
  // picture of width x height pixels.
  Camera sample(uint32_t frame, uint32_t frames, uint32_t width, uint32_t height, float near,
                float far) const;
  // Whether frame `frame` comes after a cut: nothing leads over to it from the frame before. So does the
  // first.
  bool cuts(uint32_t frame, uint32_t frames) const;
  // The camera's positions in `frames` frames.
  std::vector<glm::dvec3> positions(uint32_t frames) const;
};

}  // namespace ml
