// Depth alone, for shadow maps: the projection of gbuffer.vert from a light's own view.
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
#ifdef MASKED
layout(location = 1) in vec2 in_uv;
layout(location = 0) out vec2 out_uv;
#ifdef DETAILED
layout(location = 1) out float out_alpha;
#endif
#endif

void main() {
#ifdef MOVING
  vec3 relative = moved_position(in_position, view.camera);
#else
  vec3 relative = in_position - view.camera;
#endif
  vec3 p = vec3(dot(relative, view.right), dot(relative, view.up), dot(relative, view.forward));
  float width = view.right_edge - view.left_edge, height = view.top_edge - view.bottom_edge;
  // Reversed depth without a far plane.
  gl_Position = vec4((2.0 * p.x - (view.left_edge + view.right_edge) * p.z) / width,
                     -(2.0 * p.y - (view.bottom_edge + view.top_edge) * p.z) / height, view.near, p.z);
#ifdef MASKED
  out_uv = in_uv;
#ifdef DETAILED
  out_alpha = detail_color().a;
#endif
#endif
}
