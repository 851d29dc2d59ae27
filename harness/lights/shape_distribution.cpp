#include "harness/lights/shape_distribution.h"

#include <cmath>

#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kDegree = kPi / 180;

// Stage lights: tilted 25 to 65 degrees from straight down, half-angle 14 to 30 degrees.
void make_spot(const LightNumbers& number, Light& light) {
  double tilt = (25 + 40 * number(LightDimension::tilt)) / 360.0;
  double azimuth = number(LightDimension::azimuth);
  double level = sine_of_turns(tilt);
  light.direction = glm::vec3(glm::normalize(
      glm::dvec3(level * cosine_of_turns(azimuth), -cosine_of_turns(tilt), level * sine_of_turns(azimuth))));
  double outer = (14 + 16 * number(LightDimension::cone)) * kDegree;
  light.outer_angle = static_cast<float>(outer);
  light.inner_angle = static_cast<float>(0.7 * outer);
}

// Uniform over the sphere.
glm::dvec3 any_direction(const LightNumbers& number) {
  double azimuth = number(LightDimension::azimuth);
  double height = 1 - 2 * static_cast<double>(number(LightDimension::tilt));
  double ring = std::sqrt(std::max(0.0, 1 - height * height));
  return glm::normalize(glm::dvec3(ring * cosine_of_turns(azimuth), height, ring * sine_of_turns(azimuth)));
}

// Uniform over the circle across the light's direction.
glm::vec3 any_side(const LightNumbers& number, const Light& light) {
  double azimuth = number(LightDimension::azimuth), turn = number(LightDimension::turn);
  glm::dvec3 level(-sine_of_turns(azimuth), 0, cosine_of_turns(azimuth));
  glm::dvec3 up = glm::cross(level, glm::dvec3(light.direction));
  return glm::vec3(glm::normalize(level * cosine_of_turns(turn) + up * sine_of_turns(turn)));
}

// Half length over radius.
double slenderness(const LightNumbers& number) {
  return 0.5 + 1.5 * static_cast<double>(number(LightDimension::aspect_0));
}

void set_segment(double radius, double slender, Light& light) {
  light.radius = static_cast<float>(radius);
  light.half_length = static_cast<float>(slender * radius);
}

void make_capsule(const LightNumbers& number, Light& light) {
  light.side = glm::vec3(any_direction(number));
  double slender = slenderness(number);
  set_segment(light.radius / std::cbrt(1 + 1.5 * slender), slender, light);
}

void make_wedge(const LightNumbers& number, Light& light) {
  make_spot(number, light);
  light.side = any_side(number, light);
  double slender = slenderness(number), angle = light.outer_angle;
  double swept = 3 * slender * angle / (kPi * (1 - cosine_of_turns(angle / (2 * kPi))));
  set_segment(light.radius / std::cbrt(1 + swept), slender, light);
}

void make_random_box(const LightNumbers& number, Light& light) {
  light.direction = glm::vec3(any_direction(number));
  light.side = any_side(number, light);
  glm::dvec3 shape(0.5 + static_cast<double>(number(LightDimension::aspect_0)),
                   0.5 + static_cast<double>(number(LightDimension::aspect_1)), 1);
  double scale = light.radius * std::cbrt(kPi / (6 * shape.x * shape.y));
  make_box(light, glm::vec3(shape * scale));
}

}  // namespace

LightShape shape_of(const LightNumbers& number, const LightSpec& spec) {
  const double choice = number(LightDimension::shape);
  double end = spec.spot_fraction;
  if (choice < end) return LightShape::spot;
  end += spec.capsule_fraction;
  if (choice < end) return LightShape::capsule;
  end += spec.wedge_fraction;
  if (choice < end) return LightShape::wedge;
  end += spec.box_fraction;
  return choice < end ? LightShape::box : LightShape::omni;
}

void maybe_make_probe(const LightNumbers& number, const LightSpec& spec, Light& light) {
  light.probe = number(LightDimension::probe) < spec.probe_fraction;
  if (light.probe) light.intensity /= light.radius * light.radius;
}

void give_shape(LightShape shape, const LightNumbers& number, Light& light) {
  light.shape = shape;
  if (shape == LightShape::spot) make_spot(number, light);
  if (shape == LightShape::capsule) make_capsule(number, light);
  if (shape == LightShape::wedge) make_wedge(number, light);
  if (shape == LightShape::box) make_random_box(number, light);
}

}  // namespace ml
