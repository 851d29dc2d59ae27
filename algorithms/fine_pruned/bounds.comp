// Step 1(c): the screen bounds of each visible light. The faces of its hull are clipped against the view, corners of
// the view that lie in the hull are added, and the bounds of the balls around the light cut off what is left over. The
// view has no far end: depth is reversed.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "light_hull.glsl"
#include "pruned_lists.h"

layout(local_size_x = 64) in;
layout(constant_id = 32) const uint BOUNDS = ML_BOUNDS_HULL;
layout(scalar, binding = 16) readonly buffer Visible {
  VisibleHeader visible;
  uint visible_lights[];
};
layout(scalar, binding = 17) writeonly buffer Bounds { ScreenBounds bounds[]; };

const float none = 3e38;
const bool any_hulls = EFFECT_SPOTS || EFFECT_CAPSULES || EFFECT_WEDGES || EFFECT_BOXES;
const float widen_pixels = 1.0 / 256.0;  // as the froxel bounds
const uint max_corners = 16u;  // of a clipped face: 4 and one for each plane, and some for what rounding bends

// Window coordinates (slopes or metres) and depths.
struct WindowBounds {
  vec3 low, high;
};

// m: a little before the near plane, whose surface points may round to before it.
float near_depth() { return view.near - 1e-5 * abs(view.near); }

// 0 to 4: near, left, right, bottom, top. Inside where dot(plane.xyz, p) + plane.w >= 0.
vec4 view_plane(uint plane) {
  if (plane == 0u) return vec4(0, 0, 1, -near_depth());
  const bool orthographic = view.orthographic != 0u;
  const float edge = plane == 1u   ? view.left_edge
                     : plane == 2u ? view.right_edge
                     : plane == 3u ? view.bottom_edge
                                   : view.top_edge;
  const float sign = (plane & 1u) != 0u ? 1.0 : -1.0;
  const vec2 axis = plane <= 2u ? vec2(sign, 0) : vec2(0, sign);
  return vec4(axis, orthographic ? 0.0 : -sign * edge, orthographic ? -sign * edge : 0.0);
}

void add_point(vec3 p, float error, inout WindowBounds window) {
  const float scale = view.orthographic != 0u ? 1.0 : 1.0 / max(p.z, 0.5 * view.near);
  const vec2 projected = p.xy * scale;
  const float around = error * scale * (1.0 + max(abs(projected.x), abs(projected.y)));
  window.low = min(window.low, vec3(projected - around, p.z - error));
  window.high = max(window.high, vec3(projected + around, p.z + error));
}

// The planes that a point lies outside of, as bits.
uint planes_beyond(vec3 point) {
  const float scale = view.orthographic != 0u ? 1.0 : point.z;
  return (point.z < near_depth() ? 1u : 0u) | (point.x < view.left_edge * scale ? 2u : 0u) |
         (point.x > view.right_edge * scale ? 4u : 0u) | (point.y < view.bottom_edge * scale ? 8u : 0u) |
         (point.y > view.top_edge * scale ? 16u : 0u);
}

void add_face(LightHull hull, uvec4 corners, inout WindowBounds window) {
  vec3 face[max_corners];
  vec3 kept[max_corners];
  uint crossed = 0u, missed = 31u;
  for (uint i = 0u; i < 4u; ++i) {
    face[i] = hull_corner(hull, corners[i]);
    const uint beyond = planes_beyond(face[i]);
    crossed |= beyond;
    missed &= beyond;
  }
  uint count = missed != 0u ? 0u : 4u;
  for (uint p = 0u; p < 5u && count != 0u; ++p) {
    if ((crossed >> p & 1u) == 0u) continue;
    const vec4 plane = view_plane(p);
    uint left = 0u;
    vec3 from = face[count - 1u];
    float from_inside = dot(plane.xyz, from) + plane.w;
    for (uint i = 0u; i < count; ++i) {
      const vec3 to = face[i];
      const float to_inside = dot(plane.xyz, to) + plane.w;
      if ((from_inside >= 0.0) != (to_inside >= 0.0) && left < max_corners)
        kept[left++] = mix(from, to, from_inside / (from_inside - to_inside));
      if (to_inside >= 0.0 && left < max_corners) kept[left++] = to;
      from = to;
      from_inside = to_inside;
    }
    for (uint i = 0u; i < left; ++i) face[i] = kept[i];
    count = left;
  }
  for (uint i = 0u; i < count; ++i) add_point(face[i], hull.error, window);
}

WindowBounds hull_bounds(LightHull hull) {
  WindowBounds window = WindowBounds(vec3(none), vec3(-none));
  add_face(hull, uvec4(0, 1, 3, 2), window);
  add_face(hull, uvec4(4, 5, 7, 6), window);
  add_face(hull, uvec4(0, 1, 5, 4), window);
  add_face(hull, uvec4(2, 3, 7, 6), window);
  add_face(hull, uvec4(0, 2, 6, 4), window);
  add_face(hull, uvec4(1, 3, 7, 5), window);
  const float z = near_depth(), scale = view.orthographic != 0u ? 1.0 : z;
  for (uint i = 0u; i < 4u; ++i) {
    const vec2 window_corner =
        vec2((i & 1u) != 0u ? view.right_edge : view.left_edge, (i & 2u) != 0u ? view.top_edge : view.bottom_edge);
    const vec3 corner = vec3(window_corner * scale, z);
    if (hull_holds(hull, corner)) add_point(corner, 0.0, window);
  }
  return window;
}

// Slopes between which a ball's circle in the plane of one axis and depth is seen, as froxels/binning_scalar.cpp has it
// (Mara & McGuire 2013).
vec2 ball_interval(float a, float z, float radius) {
  const float distance2 = a * a + z * z, tangent2 = distance2 - radius * radius, tangent = sqrt(max(tangent2, 0.0));
  const float behind = z - view.near, chord = sqrt(max(radius * radius - behind * behind, 0.0));
  const float high_a = a * tangent + z * radius, high_z = z * tangent - a * radius;
  const float low_a = a * tangent - z * radius, low_z = z * tangent + a * radius;
  const bool high_seen = tangent2 > 0.0 && high_z * tangent >= view.near * distance2;
  const bool low_seen = tangent2 > 0.0 && low_z * tangent >= view.near * distance2;
  return vec2(low_seen ? low_a / low_z : (a - chord) / view.near,
              high_seen ? high_a / high_z : (a + chord) / view.near);
}

// `away`: the sum of coordinates from which the ball was computed, m.
WindowBounds window_of_ball(vec3 centre, float radius, float away) {
  radius = radius * 1.00002 + hull_absolute * away + hull_least;
  vec2 across = vec2(centre.x - radius, centre.x + radius), up = vec2(centre.y - radius, centre.y + radius);
  if (view.orthographic == 0u) {
    across = ball_interval(centre.x, centre.z, radius);
    up = ball_interval(centre.y, centre.z, radius);
  }
  return WindowBounds(vec3(across.x, up.x, centre.z - radius), vec3(across.y, up.y, centre.z + radius));
}

// What is in the ball around the light's position, out of which nothing is lit, and, for a cone, in the small one that
// its apex and its rim (up to 45 degrees) or its rim alone give: algorithms/light_bvh/light_volumes.cpp.
WindowBounds ball_bounds(LightCore light) {
  const vec3 position = to_view(light.position);
  const float away = sum_of_sizes(light.position);
  WindowBounds window = window_of_ball(position, light_bound(light), away);
  const bool wedge = is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE);
  if (!wedge && !is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT)) return window;
  const LightExtra extra = extra_at(light.id_shape & ML_LIGHT_ID_MASK);
  const float cosine = extra.cos_outer - cone_margin, sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  if (cosine <= 0.0) return window;
  const bool narrow = cosine > sine;
  const float ahead = narrow ? 0.5 * light.radius / cosine : light.radius * cosine;
  const float of_cone = narrow ? ahead : light.radius * sine, across = min(of_cone, light.radius * sine);
  const float along = wedge ? extra.half_length : 0.0;
  const float radius = sqrt(of_cone * of_cone + along * (along + 2.0 * across));
  const WindowBounds small = window_of_ball(position + to_view(extra.direction) * ahead, radius, away + ahead);
  return WindowBounds(max(window.low, small.low), min(window.high, small.high));
}

void main() {
  const uint visible_index = gl_GlobalInvocationID.x;
  if (visible_index >= visible.count) return;
  const LightCore light = light_at(visible_lights[visible_index]);
  const WindowBounds ball = ball_bounds(light);
  vec3 low = ball.low, high = ball.high;
  // The box around an omni light has the bounds of its ball inside its own: all of the hull would be cut off.
  if (BOUNDS != ML_BOUNDS_BALL && any_hulls && (light.id_shape >> 24) != ML_SHAPE_OMNI) {
    const WindowBounds hull = hull_bounds(light_hull(light, BOUNDS == ML_BOUNDS_HULL));
    low = max(hull.low, low);
    high = min(hull.high, high);
  }
  const vec2 edge = vec2(view.left_edge, view.top_edge);
  const vec2 pixels = vec2(view.resolution) / (vec2(view.right_edge, view.bottom_edge) - edge);
  const vec2 a = (low.xy - edge) * pixels, b = (high.xy - edge) * pixels;  // rows grow downwards: pixels.y < 0
  // First and last pixel whose centre is inside.
  const vec2 first = max(ceil(vec2(a.x, b.y) - (0.5 + widen_pixels)), vec2(0));
  const vec2 last = min(floor(vec2(b.x, a.y) - (0.5 - widen_pixels)), vec2(view.resolution - 1u));
  ScreenBounds result = ScreenBounds(0xffffu, 0xffffu, none, -none);
  if (all(lessThanEqual(first, last)))
    result = ScreenBounds(uint(first.x) | uint(last.x) << 16, uint(first.y) | uint(last.y) << 16,
                          low.z * (low.z > 0.0 ? 0.99999 : 1.00001), high.z * (high.z > 0.0 ? 1.00001 : 0.99999));
  bounds[visible_index] = result;
}
