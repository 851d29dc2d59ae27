// The convex hull of a light: an oriented box with a scale of its own at the top four corners (section 2.4), in view
// space.
#ifndef ML_LIGHT_HULL_GLSL
#define ML_LIGHT_HULL_GLSL
#include "shaders/light_eval.glsl"

struct LightHull {
  vec3 origin;     // m
  vec3 u, v, w;    // unit; w runs from top to base
  float low, high;  // m along w: top and base
  vec2 top, base;  // m along u and v: half sides of the top and the base
  float error;     // m: how far rounding may move a computed point of the hull
};

// Rounding of camera-relative coordinates, per metre of their sum: twice that of the froxel bounds, for devices round
// divisions and roots less well than processors do.
const float hull_absolute = 4e-6;
const float hull_relative = 1e-4;
const float hull_least = 1e-5;  // m
// What the cosine of a cone's edge is lowered by, in bounds and in the fine test: several times the rounding of a
// normalised product.
const float cone_margin = 1e-5;

vec3 to_view(vec3 p) { return vec3(dot(p, view.right), dot(p, view.up), dot(p, view.forward)); }

vec3 any_across(vec3 axis) { return normalize(cross(axis, abs(axis.z) < 0.7 ? vec3(0, 0, 1) : vec3(1, 0, 0))); }

float sum_of_sizes(vec3 p) { return abs(p.x) + abs(p.y) + abs(p.z); }

// A cone is narrowed to its apex where that leaves less volume than the straight box: (2 r tan a)^2 r / 3 < (2 r sin
// a)^2 r, cos a > 3^-1/2.
void cone_hull(LightCore light, LightExtra extra, bool wedge, bool narrowed, inout LightHull hull) {
  const float along = wedge ? extra.half_length : 0.0;
  const float cosine = max(extra.cos_outer - cone_margin, -1.0), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  hull.w = to_view(extra.direction);
  hull.u = wedge ? to_view(extra.side) : any_across(hull.w);
  hull.high = light.radius;
  if (narrowed && cosine > 0.577) {
    const float across = light.radius * sine / cosine;
    hull.low = 0.0;
    hull.top = vec2(along, 0.0);
    hull.base = vec2(along + across, across);
  } else {
    const float across = cosine > 0.0 ? light.radius * sine : light.radius;
    hull.low = min(light.radius * cosine, 0.0);
    hull.base = hull.top = vec2(along + across, across);
  }
}

// `narrowed`: with a scale of its own at the top; else a box with straight sides.
LightHull light_hull(LightCore light, bool narrowed) {
  const uint id = light.id_shape & ML_LIGHT_ID_MASK;
  LightHull hull;
  hull.origin = to_view(light.position);
  hull.u = vec3(1, 0, 0);
  hull.w = vec3(0, 0, 1);
  hull.low = -light.radius;
  hull.high = light.radius;
  hull.base = hull.top = vec2(light.radius);
  const bool wedge = is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE);
  if (wedge || is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT)) {
    cone_hull(light, extra_at(id), wedge, narrowed, hull);
  } else if (is_shape(light, EFFECT_CAPSULES, ML_SHAPE_CAPSULE)) {
    const LightExtra extra = extra_at(id);
    hull.w = to_view(extra.side);
    hull.u = any_across(hull.w);
    hull.high += extra.half_length;
    hull.low = -hull.high;
  } else if (is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX)) {
    const LightExtra extra = extra_at(id);
    const vec3 half_extents = box_half_extents(extra);
    hull.w = to_view(extra.direction);
    hull.u = to_view(extra.side);
    hull.high = half_extents.z;
    hull.low = -hull.high;
    hull.base = hull.top = half_extents.xy;
  }
  hull.v = cross(hull.w, hull.u);
  // Wider by many times what rounding moves, so that what is computed holds what is meant. Sides that slope do so by
  // less than 3/2, and the base lies further out than it did.
  const float away = sum_of_sizes(light.position), size = hull.high - hull.low, wide = max(hull.base.x, hull.base.y);
  const float margin = hull_absolute * away + hull_least;
  const float longer = margin + hull_relative * size, wider = margin + hull_relative * wide;
  hull.low -= longer;
  hull.high += longer;
  hull.top += wider;
  hull.base += wider + 1.5 * longer;
  hull.error = 0.5 * hull_absolute * (away + size + wide);
  return hull;
}

// Corner 0 to 7: bit 0 is the side along u, bit 1 along v, bit 2 the base.
vec3 hull_corner(LightHull hull, uint corner) {
  const bool base = (corner & 4u) != 0u;
  const vec2 half_sides = base ? hull.base : hull.top;
  return hull.origin + hull.w * (base ? hull.high : hull.low) +
         hull.u * ((corner & 1u) != 0u ? half_sides.x : -half_sides.x) +
         hull.v * ((corner & 2u) != 0u ? half_sides.y : -half_sides.y);
}

bool hull_holds(LightHull hull, vec3 point) {
  const vec3 from = point - hull.origin;
  const float along = dot(from, hull.w);
  const float part = clamp((along - hull.low) / (hull.high - hull.low), 0.0, 1.0);
  const vec2 half_sides = mix(hull.top, hull.base, part) + 4.0 * hull.error;
  return along >= hull.low - 4.0 * hull.error && along <= hull.high + 4.0 * hull.error &&
         abs(dot(from, hull.u)) <= half_sides.x && abs(dot(from, hull.v)) <= half_sides.y;
}

#endif
