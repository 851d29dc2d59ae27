// Whether points lie in a light's true volume (step 2(d)): four points at once, those of a thread. The same operations
// as light_sample() where that decides by exactly rounded ones; a little wider where it divides or takes roots. The
// surface's normal is no part of the volume, but may be tested besides.
#ifndef ML_LIGHT_VOLUME_GLSL
#define ML_LIGHT_VOLUME_GLSL
#include "light_hull.glsl"
#include "pruned_lists.h"
#include "shaders/light_exchange.glsl"

// With it a light holds a point only where the surface faces it.
layout(constant_id = 33) const uint PRUNE = ML_PRUNE_FINE;

// What only some shapes have of the light that is tested, where it was fetched beforehand (small subgroups); else
// fetched when it is needed.
LightExtra extra_at_hand;

LightExtra extra_of(LightCore light) {
  return small_subgroup ? extra_at_hand : extra_at(light.id_shape & ML_LIGHT_ID_MASK);
}

struct FourPoints {
  vec4 x, y, z;     // m, camera-relative, world axes
  vec4 nx, ny, nz;  // the surface's normal; only for ML_PRUNE_FACING
  bvec4 lit;        // false for the sky
};

// Vectors from the points to the light, and their squared lengths.
struct FourWays {
  vec4 x, y, z;
  vec4 squared;
};

FourWays ways_to(FourPoints points, LightCore light, bool segment) {
  precise vec4 x = vec4(light.position.x) - points.x;
  precise vec4 y = vec4(light.position.y) - points.y;
  precise vec4 z = vec4(light.position.z) - points.z;
  if (segment) {
    const LightExtra extra = extra_of(light);
    const float sx = extra.side.x, sy = extra.side.y, sz = extra.side.z, limit = extra.half_length;
    precise vec4 along = clamp(-(x * sx + y * sy + z * sz), vec4(-limit), vec4(limit));
    precise vec4 nx = x + along * sx;
    precise vec4 ny = y + along * sy;
    precise vec4 nz = z + along * sz;
    x = nx;
    y = ny;
    z = nz;
  }
  precise vec4 squared = x * x + y * y + z * z;
  return FourWays(x, y, z, squared);
}

bvec4 both(bvec4 a, bvec4 b) { return bvec4(a.x && b.x, a.y && b.y, a.z && b.z, a.w && b.w); }

// A point on the light is faced. Wider than what rounds where normals are unpacked.
bvec4 faced(FourPoints points, FourWays ways, LightCore light) {
  if (PRUNE != ML_PRUNE_FACING || is_probe(light)) return bvec4(true);
  const vec4 projected = ways.x * points.nx + ways.y * points.ny + ways.z * points.nz;
  const vec4 on_light = vec4(lessThan(ways.squared, vec4(on_point_distance_squared)));
  return greaterThan(projected + on_light, -1e-5 * (abs(ways.x) + abs(ways.y) + abs(ways.z)));
}

bvec4 within_radius(FourPoints points, FourWays ways, LightCore light) {
  precise float squared = light.radius * light.radius;
  return both(points.lit, lessThan(ways.squared, vec4(squared)));
}

// Omni lights and capsules.
bool in_ball(FourPoints points, LightCore light) {
  const FourWays ways = ways_to(points, light, is_shape(light, EFFECT_CAPSULES, ML_SHAPE_CAPSULE));
  return any(both(within_radius(points, ways, light), faced(points, ways, light)));
}

// Spots and wedges.
bool in_cone(FourPoints points, LightCore light) {
  const bool wedge = is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE);
  const FourWays ways = ways_to(points, light, wedge);
  const bvec4 near = both(within_radius(points, ways, light), faced(points, ways, light));
  if (!wedge && !is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT) || !any(near)) return any(near);
  const LightExtra extra = extra_of(light);
  const vec4 along = -(ways.x * extra.direction.x + ways.y * extra.direction.y + ways.z * extra.direction.z);
  // A point on the light has no direction: it counts.
  const vec4 edge = (extra.cos_outer - cone_margin) * sqrt(ways.squared);
  const vec4 beyond = along - edge;
  const bvec4 on_light = lessThan(ways.squared, vec4(on_point_distance_squared));
  return any(both(near, bvec4(beyond.x > 0.0 || on_light.x, beyond.y > 0.0 || on_light.y, beyond.z > 0.0 || on_light.z,
                              beyond.w > 0.0 || on_light.w)));
}

bvec4 between(FourWays ways, vec3 axis, float half_extent) {
  const vec4 coordinate = ways.x * axis.x + ways.y * axis.y + ways.z * axis.z;
  const vec4 rounding = 1e-6 * (abs(ways.x) + abs(ways.y) + abs(ways.z));
  return lessThan(abs(coordinate), half_extent * 1.00001 + rounding);
}

bool in_box_volume(FourPoints points, LightCore light) {
  const FourWays ways = ways_to(points, light, false);
  const bvec4 facing = faced(points, ways, light);
  if (!is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX)) return any(both(within_radius(points, ways, light), facing));
  const LightExtra extra = extra_of(light);
  const vec3 half_extents = box_half_extents(extra);
  const bvec4 inside =
      both(both(between(ways, extra.side, half_extents.x), between(ways, box_up(extra), half_extents.y)),
           between(ways, extra.direction, half_extents.z));
  return any(both(both(points.lit, facing), inside));
}

// Of any type.
bool in_volume(FourPoints points, LightCore light) {
  if (is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX)) return in_box_volume(points, light);
  if (is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT) || is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE))
    return in_cone(points, light);
  return in_ball(points, light);
}

#endif
