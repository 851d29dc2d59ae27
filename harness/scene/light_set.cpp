#include "harness/scene/light_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/scene/light_law.h"
#include "harness/scene/light_placement.h"
#include "harness/scene/light_script.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr uint32_t kMaxLights = 1048576;
constexpr double kDegree = 3.141592653589793 / 180;

// The closed-form scene has its own lights: equal, at one height, uniform over its area whatever the
// placement.
LightSpec adapted(LightSpec spec, const Scene& scene) {
  spec = completed(spec, scene.light_defaults);
  if (scene.name != "plane" || spec.placement == Placement::gltf) return spec;
  spec.placement = Placement::area;
  if (spec.radius == 0 && spec.base_size == 0) spec.radius = 4;
  if (spec.height == 0) spec.height = 2;
  return spec;
}

// A hue of saturation 0.6 whose channels have a mean of 1.
glm::vec3 colour_of_hue(float hue) {
  glm::vec3 colour;
  for (int channel = 0; channel < 3; ++channel) {
    float place = hue * 6 + static_cast<float>(6 - 2 * channel);
    place -= 6 * std::floor(place / 6);
    colour[channel] = 0.4f + 0.6f * std::clamp(std::abs(place - 3) - 1, 0.0f, 1.0f);
  }
  return colour * (3 / (colour.x + colour.y + colour.z));
}

// Stage lights: tilted 25 to 65 degrees from straight down, half-angle 14 to 30 degrees.
void make_spot(const LightNumbers& number, Light& light) {
  light.shape = LightShape::spot;
  double tilt = (25 + 40 * number(LightDimension::tilt)) / 360.0;
  double azimuth = number(LightDimension::azimuth);
  double level = sine_of_turns(tilt);
  light.direction = glm::vec3(glm::normalize(
      glm::dvec3(level * cosine_of_turns(azimuth), -cosine_of_turns(tilt), level * sine_of_turns(azimuth))));
  double outer = (14 + 16 * number(LightDimension::cone)) * kDegree;
  light.outer_angle = static_cast<float>(outer);
  light.inner_angle = static_cast<float>(0.7 * outer);
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

const std::vector<std::string>& placement_names() {
  static const std::vector<std::string> names{"volume", "triangle", "area", "gltf"};
  return names;
}

const std::vector<std::string>& sizing_names() {
  static const std::vector<std::string> names{"const_overdraw", "fixed_size"};
  return names;
}

const std::vector<std::string>& light_script_names() {
  static const std::vector<std::string> names{"static", "drift", "spawn"};
  return names;
}

LightSpec completed(LightSpec spec, const LightDefaults& defaults) {
  if (!spec.placement) spec.placement = defaults.placement;
  if (spec.radius_ratio == 0) spec.radius_ratio = defaults.radius_ratio;
  return spec;
}

const char* rejection_reason(const Light& light) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(light.position[axis])) return "position is not finite";
    if (std::abs(light.position[axis]) > kMaxLightPosition) return "position is beyond 1e12 m";
  }
  if (!std::isfinite(light.radius)) return "radius is not finite";
  if (light.radius < 0) return "radius is negative";
  if (light.radius == 0) return "radius is 0";
  if (light.radius < kMinLightRadius) return "radius is below 1e-12 m";
  if (light.radius > kMaxLightRadius) return "radius is above 1e12 m";
  if (!finite(light.intensity)) return "intensity is not finite";
  if (light.intensity.x < 0 || light.intensity.y < 0 || light.intensity.z < 0) return "intensity is negative";
  if (light.shape != LightShape::spot) return nullptr;
  if (!finite(light.direction)) return "direction is not finite";
  float square = glm::dot(light.direction, light.direction);
  if (!(std::abs(square - 1) < 1e-3f)) return "direction is not of unit length";
  if (!std::isfinite(light.inner_angle) || !std::isfinite(light.outer_angle))
    return "cone angle is not finite";
  if (light.outer_angle <= 0) return "outer cone angle is not above 0";
  if (light.outer_angle > 3.1415928f) return "outer cone angle is above pi";
  if (light.inner_angle < 0) return "inner cone angle is negative";
  if (light.inner_angle > light.outer_angle) return "inner cone angle is above the outer";
  return nullptr;
}

LightSet::LightSet(const LightSpec& spec, const Scene& scene) : spec_(adapted(spec, scene)) {
  if (spec_.count > kMaxLights) {
    throw UsageError(fmt::format("lights: count is {}, expected at most {}", spec_.count, kMaxLights));
  }
  auto accept = [this](const Light& light) {
    if (const char* reason = rejection_reason(light)) {
      ++rejected_[reason];
    } else {
      lights_.push_back(light);
    }
  };

  if (spec_.placement == Placement::gltf) {
    if (scene.lights.empty()) {
      throw UsageError(
          one_line(fmt::format("scene '{}': it has no lights of its own for placement 'gltf'", scene.name)));
    }
    size_t count = std::min<size_t>(spec_.count, scene.lights.size());
    lights_.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      Light light = scene.lights[i];
      if (spec_.radius > 0) light.radius = spec_.radius;
      light.intensity *= spec_.intensity;
      accept(light);
    }
    return;
  }

  double s0 = spec_.base_size > 0
                  ? spec_.base_size
                  : default_base_size(scene, *spec_.placement, static_cast<double>(spec_.radius_ratio));
  size_ = spec_.radius > 0
              ? spec_.radius
              : static_cast<float>(size_for_count(s0, spec_.count, spec_.sizing, *spec_.placement));
  if (spec_.count == 0) return;
  std::optional<SurfaceSampler> surface;
  if (spec_.placement != Placement::volume) surface.emplace(scene, spec_.placement == Placement::area);

  glm::dvec3 corner(scene.bounds.min), extent(glm::dvec3(scene.bounds.max) - corner);
  lights_.reserve(spec_.count);
  for (uint32_t i = 0; i < spec_.count; ++i) {
    LightNumbers number(hash_u32(spec_.seed), i);
    Light light;
    light.radius = spec_.radius > 0
                       ? spec_.radius
                       : pareto_radius(number(LightDimension::radius), size_, spec_.radius_ratio);
    glm::dvec3 choice(number(LightDimension::place_0), number(LightDimension::place_1),
                      number(LightDimension::place_2));
    if (surface) {
      SurfaceSampler::Point point = surface->at(choice.x, choice.y, choice.z);
      double lift = spec_.height > 0 ? spec_.height
                                     : 0.5 * static_cast<double>(light.radius) * number(LightDimension::lift);
      light.position = point.position + lift * point.normal;
    } else {
      light.position = corner + extent * choice;
    }
    glm::vec3 colour = colour_of_hue(number(LightDimension::hue));
    light.intensity = colour * static_cast<float>(intensity_for_radius(light.radius)) * spec_.intensity;
    if (number(LightDimension::is_spot) < spec_.spot_fraction) make_spot(number, light);
    accept(light);
  }
}

void LightSet::at(uint32_t frame, uint32_t frames, double duration, std::vector<Light>& out) const {
  run_script(spec_.script, spec_.seed, script_time(frame, frames, duration), lights_, out);
}

}  // namespace ml
