// Camera-relative projection: the camera is subtracted from the vertex in the scene's own coordinates, then rotated,
// then projected. DETAILED: levels that know more of their vertices (details.glsl). MOVING: levels with meshes that
// move (motion.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#define SURFACE_WRITER
#include "shaders/surface.glsl"
#ifdef DETAILED
#include "shaders/details.glsl"
#endif
#ifdef MOVING
#include "shaders/motion.glsl"
#endif

layout(location = 0) in vec3 in_position;  // m, relative to the scene's origin
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_uv;
layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec2 out_uv;
// These two are for the forward pass, which is one program with and without details.
layout(location = 2) out vec4 out_color;
layout(location = 3) out vec2 out_metallic_roughness_uv;
#ifdef DETAILED
layout(location = 4) out vec4 out_tangent;
layout(location = 5) out vec2 out_normal_uv;
layout(location = 6) out vec2 out_emission_uv;
layout(location = 7) out vec3 out_relative;  // m, camera-relative, world axes
#endif

void main() {
#ifdef MOVING
  precise vec3 relative = moved_position(in_position, view.camera);
#else
  vec3 relative = in_position - view.camera;
#endif
  vec3 p = vec3(dot(relative, view.right), dot(relative, view.up), dot(relative, view.forward));
  bool orthographic = view.orthographic != 0u;
  float w = orthographic ? 1.0 : p.z;
  float width = view.right_edge - view.left_edge, height = view.top_edge - view.bottom_edge;
  // Reversed depth: near / z without a far plane, or linear from 1 at near to 0 at far. The picture's y points down.
  float depth = orthographic ? (view.far - p.z) / (view.far - view.near) : view.near;
  // The forward pass draws its triangles again and finds them by equal depth: exactly as written, in every program.
  // (`invariant` would say the same; Debian 12's validation layer does not know it on a member of a block.)
  precise vec4 position = vec4((2.0 * p.x - (view.left_edge + view.right_edge) * w) / width,
                               -(2.0 * p.y - (view.bottom_edge + view.top_edge) * w) / height, depth, w);
  gl_Position = position;
#ifdef MOVING
  out_normal = moved_normal(in_normal);
#else
  out_normal = in_normal;
#endif
  out_uv = in_uv;
#ifdef DETAILED
  out_color = detail_color();
  out_metallic_roughness_uv = detail_uv(ML_DETAIL_METALLIC_ROUGHNESS_UV, in_uv);
  out_tangent = detail_tangent();
#ifdef MOVING
  out_tangent = vec4(moved_direction(out_tangent.xyz), out_tangent.w);
#endif
  out_normal_uv = detail_uv(ML_DETAIL_NORMAL_UV, in_uv);
  out_emission_uv = detail_uv(ML_DETAIL_EMISSION_UV, in_uv);
  out_relative = relative;
#else
  out_color = vec4(1.0);
  out_metallic_roughness_uv = in_uv;
#endif
}
