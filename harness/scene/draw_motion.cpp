#include "harness/scene/draw_motion.h"

#include <algorithm>
#include <cmath>

namespace ml {
namespace {

constexpr uint32_t times_between_keys = 7;
// So many draws are followed from key to key; of more, each at so many times spread over the motion.
constexpr size_t max_followed = 256;
constexpr int even_times = 64;
constexpr double max_coordinate = 1e9;  // m, as for vertices that stand still

// From the scene's coordinates at rest to those at `time`.
glm::dmat4 moved_by(const NodeMotions& motions, const glm::dvec3& center, const DrawMotion& motion,
                    double time) {
  glm::dmat4 world = motions.world(motion.node, time);
  world[3] -= glm::dvec4(center, 0);
  return world * motion.from_rest;
}

Bounds bounds_of(const Scene& scene, const Draw& draw) {
  const glm::vec3& first = scene.vertices[scene.indices[draw.first_index]].position;
  Bounds bounds{first, first};
  for (uint32_t i = 0; i < draw.index_count; ++i) {
    const glm::vec3& position = scene.vertices[scene.indices[draw.first_index + i]].position;
    bounds.min = glm::min(bounds.min, position);
    bounds.max = glm::max(bounds.max, position);
  }
  return bounds;
}

void widen(Bounds& bounds, const Bounds& box, const glm::dmat4& moved) {
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = double{corner >> axis & 1 ? box.max[axis] : box.min[axis]};
    at = glm::dvec3(moved * glm::dvec4(at, 1));
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(at[axis]) <= max_coordinate)) return;
    bounds.min = glm::min(bounds.min, glm::vec3(at));
    bounds.max = glm::max(bounds.max, glm::vec3(at));
  }
}

std::vector<double> times_of(const Scene& scene, const DrawMotion& motion) {
  const NodeMotions& motions = *scene.motions;
  if (scene.draw_motions.size() <= max_followed)
    return sample_times(motions, motion.node, times_between_keys);
  std::vector<double> times;
  for (int i = 0; i < even_times; ++i)
    times.push_back(motions.begin() + motions.duration() * i / (even_times - 1));
  return times;
}

}  // namespace

DrawPose pose_of(const NodeMotions& motions, const glm::dvec3& center, const DrawMotion& motion,
                 double time) {
  const glm::dmat4 moved = moved_by(motions, center, motion, time);
  const glm::dvec3 pivot(moved * glm::dvec4(glm::dvec3(motion.pivot), 1));
  DrawPose pose;
  pose.linear = glm::mat3(moved);
  pose.pivot = motion.pivot;
  pose.moved_pivot = glm::vec3(pivot);
  for (int axis = 0; axis < 3; ++axis) pose.seen = pose.seen && std::abs(pivot[axis]) <= max_coordinate;
  const double volume = glm::determinant(glm::dmat3(moved));
  pose.seen = pose.seen && std::isfinite(volume) && volume != 0;
  pose.mirrored = volume < 0;
  return pose;
}

DrawPose pose_of(const Scene& scene, const Draw& draw, double time) {
  if (draw.motion < 0) return {};
  return pose_of(*scene.motions, scene.motion_center, scene.draw_motions[static_cast<size_t>(draw.motion)],
                 time);
}

void finish_motion(Scene& scene) {
  if (scene.draw_motions.empty()) return;
  for (const Draw& draw : scene.draws) {
    if (draw.motion < 0) continue;
    DrawMotion& motion = scene.draw_motions[static_cast<size_t>(draw.motion)];
    const Bounds box = bounds_of(scene, draw);
    motion.pivot = box.center();
    for (double time : times_of(scene, motion))
      widen(scene.bounds, box, moved_by(*scene.motions, scene.motion_center, motion, time));
  }
}

}  // namespace ml
