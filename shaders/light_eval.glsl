// What one light gives to one surface point, and when it gives anything at all: the single definition that every pass
// uses.
//
// Falloff: inverse square, windowed to exactly zero at the radius: (1 - (d/r)^4)^2 / max(d^2, 1e-4 m^2), the window of
// B. Karis, "Real Shading in Unreal Engine 4", 2013; d to the nearest point of the light's source. The shapes:
// harness/scene/light.h. BRDF: Lambert + GGX with height-correlated Smith visibility and Schlick's Fresnel.
#ifndef ML_LIGHT_EVAL_GLSL
#define ML_LIGHT_EVAL_GLSL
#include "shaders/constants.glsl"
#include "shaders/numbers.glsl"
#include "shaders/quads.glsl"
#include "shaders/shared/light.h"
#include "shaders/surface.glsl"

layout(scalar, binding = BIND_LIGHTS) readonly buffer Lights { LightCore lights[]; };
layout(scalar, binding = BIND_EXTRAS) readonly buffer Extras { LightExtra extras[]; };
QUADS(LightsQuads, BIND_LIGHTS);
QUADS(ExtrasQuads, BIND_EXTRAS);

LightCore light_of_quads(usamplerBuffer quads, uint light) {
  const int quad = int(2u * light);
  const uvec4 a = texelFetch(quads, quad), b = texelFetch(quads, quad + 1);
  return LightCore(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w);
}

LightCore light_at(uint light) {
  if (TEXEL_FETCH) return light_of_quads(LightsQuads, light);
  return lights[light];
}

LightExtra extra_at(uint light) {
  if (!TEXEL_FETCH) return extras[light];
  const int quad = int(3u * light);
  const vec4 a = uintBitsToFloat(texelFetch(ExtrasQuads, quad)), b = uintBitsToFloat(texelFetch(ExtrasQuads, quad + 1)),
             c = uintBitsToFloat(texelFetch(ExtrasQuads, quad + 2));
  return LightExtra(a.xyz, a.w, b.xyz, b.w, c.x, c.y, c.z, c.w);
}

const float min_distance_squared = 1e-4;     // m^2: a light is at least a ball of 1 cm
// M^2: nearer than this the light has no direction, and shines along the normal.
const float on_point_distance_squared = 1e-12;
const float min_roughness = 0.045;           // keeps GGX finite in single precision

// Geometry of a light as seen from a point.
struct LightSample {
  VEC3 direction;  // unit, to the light
  REAL cosine;     // of the surface; probe lights: 1, they come from all sides
  REAL strength;   // falloff * cone, 1/m^2
};

bool is_shape(LightCore light, bool effect, uint shape) {
  return effect && light.id_shape >> 24 == shape;
}

const bool any_extras = EFFECT_SPOTS || EFFECT_CAPSULES || EFFECT_WEDGES || EFFECT_BOXES;

bool has_extra(LightCore light) {
  return is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT) || is_shape(light, EFFECT_CAPSULES, ML_SHAPE_CAPSULE) ||
         is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE) || is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX);
}

bool is_probe(LightCore light) { return EFFECT_PROBES && (light.id_shape & ML_LIGHT_PROBE) != 0u; }

// m: the light gives nothing beyond this distance from its position.
float light_bound(LightCore light) {
  if (is_shape(light, EFFECT_CAPSULES, ML_SHAPE_CAPSULE) || is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE) ||
      is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX))
    return extra_at(light.id_shape & ML_LIGHT_ID_MASK).bound_radius;
  return light.radius;
}

// Moves (dx, dy, dz) from the light's centre to the nearest point of its source segment; without a length it stays, bit
// for bit.
void to_segment(LightExtra extra, inout REAL dx, inout REAL dy, inout REAL dz) {
  REAL sx = REAL(extra.side.x), sy = REAL(extra.side.y), sz = REAL(extra.side.z), limit = REAL(extra.half_length);
  precise REAL along = clamp(-(dx * sx + dy * sy + dz * sz), -limit, limit);
  precise REAL x = dx + along * sx;
  precise REAL y = dy + along * sy;
  precise REAL z = dz + along * sz;
  dx = x;
  dy = y;
  dz = z;
}

// The part of a box's window that belongs to one axis; false outside. An extent of 0 gives an infinite or no number:
// outside.
bool in_slab(REAL ax, REAL ay, REAL az, REAL half_extent, REAL dx, REAL dy, REAL dz, inout REAL window) {
  precise REAL coordinate = dx * ax + dy * ay + dz * az;
  precise REAL ratio = coordinate * coordinate / (half_extent * half_extent);
  precise REAL product = window * (REAL(1) - ratio * ratio);
  window = product;
  return ratio < REAL(1);
}

bool in_box(LightExtra extra, REAL dx, REAL dy, REAL dz, out REAL window) {
  VEC3 half_extents = VEC3(box_half_extents(extra)), side = VEC3(extra.side), front = VEC3(extra.direction);
  precise REAL ux = front.y * side.z - front.z * side.y;
  precise REAL uy = front.z * side.x - front.x * side.z;
  precise REAL uz = front.x * side.y - front.y * side.x;
  window = REAL(1);
  return in_slab(side.x, side.y, side.z, half_extents.x, dx, dy, dz, window) &&
         in_slab(ux, uy, uz, half_extents.y, dx, dy, dz, window) &&
         in_slab(front.x, front.y, front.z, half_extents.z, dx, dy, dz, window);
}

// False when the light does not contribute: window 0, behind the surface (unless it is a probe), or outside the cone.
// `precise` because every pass must decide alike. `extra`: what its shape needs, if anything.
bool light_sample(SurfacePoint point, LightCore light, LightExtra extra, out LightSample result) {
  result.direction = VEC3(0);
  result.cosine = REAL(0);
  result.strength = REAL(0);
  const bool probe = is_probe(light);
  const bool spot = is_shape(light, EFFECT_SPOTS, ML_SHAPE_SPOT),
             wedge = is_shape(light, EFFECT_WEDGES, ML_SHAPE_WEDGE);
  const bool capsule = is_shape(light, EFFECT_CAPSULES, ML_SHAPE_CAPSULE),
             box = is_shape(light, EFFECT_BOXES, ML_SHAPE_BOX);
  precise REAL dx = REAL(light.position.x) - REAL(point.position.x);
  precise REAL dy = REAL(light.position.y) - REAL(point.position.y);
  precise REAL dz = REAL(light.position.z) - REAL(point.position.z);
  if (wedge || capsule) to_segment(extra, dx, dy, dz);
  precise REAL distance_squared = dx * dx + dy * dy + dz * dz;
  precise REAL window;
  if (box) {
    REAL product;
    if (!in_box(extra, dx, dy, dz, product)) return false;
    window = product;
  } else {
    precise REAL radius_squared = REAL(light.radius) * REAL(light.radius);
    if (!(distance_squared < radius_squared)) return false;
    // A division may round to 1 what is less: then the window is 0, and the light contributes nothing.
    precise REAL ratio = min(distance_squared / radius_squared, REAL(1));
    window = REAL(1) - ratio * ratio;
  }
  VEC3 normal = VEC3(point.normal);
  if (distance_squared < REAL(on_point_distance_squared)) {
    result.direction = normal;
    result.cosine = REAL(1);
  } else {
    precise REAL projected = dx * normal.x + dy * normal.y + dz * normal.z;
    if (!probe && !(projected > REAL(0))) return false;
    REAL inverse = REAL(1) / sqrt(distance_squared);
    result.direction = VEC3(dx, dy, dz) * inverse;
    result.cosine = probe ? REAL(1) : min(projected * inverse, REAL(1));
  }
  result.strength = window * window / (probe ? REAL(1) : max(distance_squared, REAL(min_distance_squared)));
  if (wedge || spot) {
    // 1 - cos as half the square of the chord between the two directions. The rounding of their lengths is along the
    // chord's normal and falls away; a difference of cosines would leave few digits where a narrow cone's edge is all
    // that lights a pixel.
    precise REAL chord_x = result.direction.x + REAL(extra.direction.x);
    precise REAL chord_y = result.direction.y + REAL(extra.direction.y);
    precise REAL chord_z = result.direction.z + REAL(extra.direction.z);
    precise REAL aside = REAL(0.5) * (chord_x * chord_x + chord_y * chord_y + chord_z * chord_z);
    precise REAL cone = min((REAL(extra.cone_limit) - aside) * REAL(extra.cone_scale), REAL(1));
    if (!(cone > REAL(0))) return false;
    result.strength *= cone * cone;
  }
  return true;
}

bool light_sample(SurfacePoint point, LightCore light, out LightSample result) {
  // Once, for all that ask for it: where lanes run in step every question would be a fetch.
  LightExtra extra;
  if (has_extra(light)) extra = extra_at(light.id_shape & ML_LIGHT_ID_MASK);
  return light_sample(point, light, extra, result);
}

const float lambert = 0.31830988618379067;  // 1 / pi
const float dielectric_f0 = 0.04;           // what a surface that is no metal mirrors straight on

// GGX's distribution times visibility, and Schlick's weight of a full mirror; false where there is no highlight.
bool highlight(SurfacePoint point, LightSample from, out REAL lobe, out REAL grazing) {
  lobe = REAL(0);
  grazing = REAL(0);
  if (!EFFECT_SPECULAR) return false;
  VEC3 normal = VEC3(point.normal), to_eye = VEC3(point.to_eye);
  VEC3 between = from.direction + to_eye;
  REAL length_squared = dot(between, between);
  // Light straight behind the surface point as the eye sees it: there is no half vector and no highlight.
  if (!(length_squared > REAL(1e-12))) return false;
  VEC3 half_vector = between / sqrt(length_squared);
  REAL n_v = clamp(abs(dot(normal, to_eye)), REAL(1e-4), REAL(1));
  REAL n_h = clamp(dot(normal, half_vector), REAL(0), REAL(1));
  REAL v_h = clamp(dot(to_eye, half_vector), REAL(0), REAL(1));
  REAL roughness = max(REAL(point.roughness), REAL(min_roughness));
  REAL a2 = roughness * roughness * roughness * roughness;
  // 1 - n_h^2 as a cross product: the difference would lose all digits at the highlight of a smooth surface.
  VEC3 aside = cross(normal, half_vector);
  REAL spread = n_h * n_h * a2 + dot(aside, aside);
  REAL distribution = a2 / max(REAL(3.14159265358979323846) * spread * spread, REAL(1e-30));
  REAL visibility = REAL(0.5) / (from.cosine * sqrt(n_v * n_v * (REAL(1) - a2) + a2) +
                                 n_v * sqrt(from.cosine * from.cosine * (REAL(1) - a2) + a2));
  REAL away = REAL(1) - v_h;
  REAL away2 = away * away;
  lobe = distribution * visibility;
  grazing = away2 * away2 * away;
  return true;
}

// Light that leaves the point towards the eye, W/(sr m^2).
VEC3 light_shade(SurfacePoint point, LightCore light, LightSample from) {
  VEC3 albedo = VEC3(point.albedo);
  REAL metallic = REAL(point.metallic);
  VEC3 brdf = albedo * ((REAL(1) - metallic) * REAL(lambert));
  REAL lobe, grazing;
  if (!is_probe(light) && highlight(point, from, lobe, grazing)) {
    VEC3 f0 = mix(VEC3(dielectric_f0), albedo, metallic);
    VEC3 fresnel = f0 + (VEC3(1) - f0) * grazing;
    brdf += fresnel * lobe;
  }
  return VEC3(light.intensity) * brdf * (from.strength * from.cosine);
}

// The same without the albedo: the light is albedo * diffuse + specular. Albedo enters light_shade to the first power
// only, by Lambert's term and by the colour of metals in f0; `diffuse` is all that it multiplies, so a metal's coloured
// highlights too.
void light_shade_split(SurfacePoint point, LightCore light, LightSample from, out VEC3 diffuse, out VEC3 specular) {
  REAL metallic = REAL(point.metallic);
  REAL coloured = (REAL(1) - metallic) * REAL(lambert), plain = REAL(0);
  REAL lobe, grazing;
  if (!is_probe(light) && highlight(point, from, lobe, grazing)) {
    REAL straight = (REAL(1) - grazing) * lobe;  // what f0 multiplies
    coloured += metallic * straight;
    plain = (REAL(1) - metallic) * REAL(dielectric_f0) * straight + grazing * lobe;
  }
  VEC3 arriving = VEC3(light.intensity) * (from.strength * from.cosine);
  diffuse = arriving * coloured;
  specular = arriving * plain;
}

// A well-mixed 32-bit hash of a light's index: sums of it tell which set of lights was reached.
uint light_hash(uint index) {
  uint state = index * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

#endif
