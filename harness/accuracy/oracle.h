// The double-precision CPU oracle: every light, straightforwardly, for given surface points. Shares no code
// with the GPU.
//
// radiance = emission + sum over lights of intensity * falloff * cone * N.L * (diffuse + specular), where
//   diffuse  = albedo * (1 - metallic) / pi
//   specular = D V F: GGX with alpha = max(roughness, 0.045)^2, height-correlated Smith visibility, Schlick's
//   Fresnel term from
//              f0 = mix(0.04, albedo, metallic). Sources: B. Walter et al., "Microfacet Models for Refraction
//              through Rough Surfaces", EGSR 2007; E. Heitz, "Understanding the Masking-Shadowing Function",
//              JCGT 3(2), 2014; C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
// and for probe lights intensity * window * cone * diffuse.
// A light contributes iff falloff > 0, N.L > 0 (or it is a probe) and cone > 0. L, distance and cone are
// taken from the nearest point of the light's source, a segment or a point. A light within 1e-6 m of the
// point has no direction: it counts as shining from straight above (L = N, distance 0), so that the sum stays
// finite.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace ml {

// A shaded point, camera-relative (world axes), as the g-buffer has it.
struct SurfacePoint {
  glm::dvec3 position{0};      // m; the camera is at 0
  glm::dvec3 normal{0, 1, 0};  // unit, to double precision
  glm::dvec3 albedo{0.5};
  double roughness = 0.8, metallic = 0;
  glm::dvec3 emission{0};  // W/m^2/sr that the surface gives by itself
  // Unit, towards the viewer. Zero: perspective, towards the camera at 0. Orthographic: against the camera's
  // forward axis.
  glm::dvec3 view{0};
};

// A light as the GPU has it, in double.
struct OracleLight {
  glm::dvec3 position{0};  // m, camera-relative
  double radius = 1;
  glm::dvec3 intensity{1};
  bool spot = false;
  glm::dvec3 direction{0, -1, 0};
  double cone_scale = 1, cone_limit = 4;  // cone_limit: 1 - cos of the outer angle
  // The source is the segment position +- half_length * side.
  glm::dvec3 side{1, 0, 0};
  double half_length = 0;  // m
  // The window is a box's in place of the ball's; half extents along side, cross(direction, side), direction.
  bool box = false;
  glm::dvec3 half_extents{0};  // m
  // Ambient light in the volume: the window alone in place of the falloff, neither N.L nor specular.
  bool probe = false;
};

struct OracleAnswer {
  glm::dvec3 radiance{0};
  uint32_t contributing = 0;
  // Lights so near to the edge of contributing (distance within 1e-5 of the radius, cosine within 1e-5 of 0
  // or of the cone's edge, relative; a position within 1e-5 of a box's face) that single precision may decide
  // otherwise; they count in `contributing` by the double answer. Near a long segment the margins grow as the
  // distance along it to the distance from it, for single precision knows the offset only within its rounding
  // of the longer one; and nowhere are they less than what rounding may take (rounding.h). A light that
  // another condition excludes clearly is not among them.
  uint32_t marginal = 0;
  // Per channel: no evaluation of the same sum in single precision, from the same point and lights, is
  // farther from `radiance` than this. It follows from how each light's contribution reacts to rounding here:
  // some parts in a million at ordinary points, per cents at the edge of a cone, all of a light that rounding
  // may switch on or off (rounding.h).
  glm::dvec3 tolerance{0};
};

OracleAnswer oracle_shade(const SurfacePoint& point, std::span<const OracleLight> lights, bool specular);

// One light's windowed inverse-square falloff in double: (1 - (d/r)^4)^2, exactly 0 from d = r on, over
// max(d^2, 1e-4 m^2). Window: B. Karis, "Real Shading in Unreal Engine 4", 2013.
double oracle_falloff(double distance, double radius);

// The same for a box: the product of (1 - (l/h)^4)^2 over the axes for `position` l in the box's axes,
// exactly 0 at and outside its faces and for an extent of 0.
double oracle_box_falloff(const glm::dvec3& position, const glm::dvec3& half_extents);

// clamp((limit - (1 - cosine)) * scale, 0, 1)^2; 1 for lights that are no spots.
// `cosine`: between the spot's axis and the direction from the light to the point.
double oracle_cone(const OracleLight& light, double cosine);

// Diffuse plus, when wanted, specular reflection (1/sr), N.L not included. All directions unit, away from the
// point; N.L > 0. N.V is taken as max(|N.V|, 1e-4), as interpolated normals may face away from the viewer;
// where the half vector then is below the surface, N.H is 0 in GGX's N.H^2 alpha^2 + sin^2, and the sine its
// own.
glm::dvec3 oracle_brdf(const SurfacePoint& point, const glm::dvec3& to_light, const glm::dvec3& to_viewer,
                       bool specular);

}  // namespace ml
