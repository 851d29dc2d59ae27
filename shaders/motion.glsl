// What vertex shaders of levels with moving meshes (MOVING) read of a draw beside its material, and where its vertices
// are in this frame.
#ifndef ML_MOTION_GLSL
#define ML_MOTION_GLSL
#include "shaders/shared/material.h"

layout(push_constant, scalar) uniform Push {
  MaterialData material;
  MotionData motion;
};

// Camera-relative. A mesh that stands still gets the bits that a level without motion has: times 1, plus 0.
vec3 moved_position(vec3 position, vec3 camera) {
  precise vec3 relative = motion.linear * (position - motion.pivot) + (motion.moved_pivot - camera);
  return relative;
}

vec3 moved_direction(vec3 direction) { return motion.linear * direction; }

// The inverse transpose but for a positive factor: mirrored meshes keep their normals' side.
vec3 moved_normal(vec3 normal) {
  const mat3 m = motion.linear;
  const mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
  return (dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0) * (cofactors * normal);
}

#endif
