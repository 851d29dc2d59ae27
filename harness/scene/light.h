// Lights as the scene has them: shape, position, radius of influence and radiant intensity.
//
// What a light gives to a surface point p with normal N, with q the nearest point of its source to p, d =
// |p - q| and L the direction from p to q; nothing unless N.L > 0. With d < 1e-6 m the light has no direction
// and shines along the normal (L = N).
//   omni     The source is the position. intensity * W / max(d^2, 1e-4 m^2), window W = (1 - (d/r)^4)^2, 0
//   from
//            d = radius on. Volume: the ball.
//   spot     An omni light times the cone factor clamp(cos * scale + offset, 0, 1)^2 of the angle between
//            `direction` and p - q: 1 up to inner_angle, 0 from outer_angle on. Volume: the ball's sector.
//   capsule  An omni light whose source is the segment position +- half_length * side. Volume: the capsule.
//            Without a length it is exactly an omni light.
//   wedge    A spot whose source is that segment, `side` across `direction`: the cone stands on q. Volume: in
//            the spot's sector swept along the segment. Without a length it is exactly a spot.
//   box      The source is the position. The window is the product of (1 - (l/h)^4)^2 over the three axes, l
//            the coordinate of p along the axis and h the half extent, 0 at and outside the faces. The axes
//            are side, cross(direction, side) and direction: right-handed. Volume: the box.
//
// A probe light (`probe`, in any shape) stands for an environment probe: ambient light in the shape's volume,
// from all sides at once. It gives intensity (here W/m^2) * W [* cone factor] to every surface point in its
// volume, whichever way the surface faces, and only diffusely: no N.L, no highlight, no inverse square.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace ml {

// The values are part of the GPU format (shaders/shared/light.h).
enum class LightShape : uint32_t { omni = 0, spot = 1, capsule = 2, wedge = 3, box = 4 };

// "omni", "spot", "capsule", "wedge", "box", in the order of the enumerators.
const std::vector<std::string>& light_shape_names();

struct Light {
  glm::dvec3 position{0};  // m, relative to Scene::origin
  float radius = 1;        // m, > 0: no contribution at or beyond this distance; boxes: |half_extents|
  glm::vec3 intensity{1};  // W/sr per colour channel, >= 0; probe lights: W/m^2
  LightShape shape = LightShape::omni;
  glm::vec3 direction{0, -1, 0};  // unit; spots, wedges: the axis, away from the light; boxes: the third axis
  float inner_angle = 0;          // radians; spots, wedges: half-angle inside which the cone factor is 1
  float outer_angle =
      0.7853982f;  // radians, (inner_angle, pi]; spots, wedges: half-angle at and beyond which it is 0
  glm::vec3 side{1, 0, 0};    // unit; capsules: the segment; wedges, boxes: across `direction`
  float half_length = 0;      // m, >= 0; capsules, wedges
  glm::vec3 half_extents{0};  // m, > 0; boxes: along side, cross(direction, side), direction
  bool probe = false;
};

// How many lights were refused and why ("radius is 0", "radius is negative", "its node has scale 0", ...);
// each is counted once, by the first reason that holds.
using Rejections = std::map<std::string, uint32_t>;

inline bool has_cone(LightShape shape) {
  return shape == LightShape::spot || shape == LightShape::wedge;
}
inline bool has_segment(LightShape shape) {
  return shape == LightShape::capsule || shape == LightShape::wedge;
}

// A box of these half extents (m), with the radius that belongs to them.
void make_box(Light& light, const glm::vec3& half_extents);

// Puts the light where a node of a level stands, with its directions: the node's -z is the direction, its x
// the side. Scale and reflection leave the shape alone; where a sheared node's axes are not at right angles,
// the direction stays and the side gives way. False, and the light as it was, where the node's scale is 0 and
// it has no position or no directions. `world` in metres, relative to the scene's origin.
bool place_on_node(Light& light, const glm::dmat4& world);

// The light `factor` times as large: radius, and half length or half extents where there are any.
void scale_size(Light& light, double factor);

}  // namespace ml
