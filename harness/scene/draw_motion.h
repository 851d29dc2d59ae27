// How the meshes of a level move: which node carries a draw, and where it is at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

// Takes a point p of Scene::vertices to linear * (p - pivot) + moved_pivot, in metres relative to the scene's
// origin. Made in double; the pivot lies in the middle of the draw, so that rounding to float is as small as
// for vertices that stand still.
struct DrawPose {
  bool seen = true;       // false: the node has scale 0 (or leaves all bounds) at that time
  bool mirrored = false;  // triangles are turned over (an odd number of axes changed its sign)
  glm::mat3 linear{1};
  glm::vec3 pivot{0}, moved_pivot{0};
};

// Of what `motion` carries; `center` is Scene::motion_center.
DrawPose pose_of(const NodeMotions& motions, const glm::dvec3& center, const DrawMotion& motion, double time);
// Of a draw of `scene`, at `time` of Scene::motions' clock. A draw that stands still has the pose of the
// default constructor.
DrawPose pose_of(const Scene& scene, const Draw& draw, double time);

// Finds the pivots of all draws that move, and widens Scene::bounds by what their boxes sweep over, at
// sampled times.
void finish_motion(Scene& scene);

}  // namespace ml
