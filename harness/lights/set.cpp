#include "harness/lights/set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/lights/clumps.h"
#include "harness/lights/placement.h"
#include "harness/lights/positions.h"
#include "harness/lights/radius_distribution.h"
#include "harness/lights/script.h"
#include "harness/lights/shape_distribution.h"
#include "harness/lights/stage.h"

namespace ml {
namespace {

constexpr uint32_t kMaxLights = 1048576;
constexpr float kRoomRadius = 8;  // m, of placement `room`

// Placements that bring their own distribution of radii.
bool has_own_radii(std::optional<Placement> placement) {
  return placement == Placement::clumps || placement == Placement::stage || placement == Placement::room;
}

LightSpec adapted(LightSpec spec, const Scene& scene) {
  const LightDefaults& defaults = scene.light_defaults;
  spec = completed(spec, defaults);
  const bool placed = spec.placement != Placement::gltf;  // else sizes and positions are the file's
  if (placed && defaults.fixed_placement) spec.placement = defaults.placement;
  if (placed && spec.radius == 0 && spec.base_size == 0) spec.radius = defaults.radius;
  if (placed && spec.height == 0) spec.height = defaults.height;
  if (spec.placement == Placement::room && spec.radius == 0 && spec.base_size == 0) spec.radius = kRoomRadius;
  if (spec.radius_ratio == 0)
    spec.radius_ratio =
        spec.placement == Placement::clumps ? clump_radius_ratio(spec.count) : LightDefaults().radius_ratio;
  return spec;
}

// A hue of saturation 0.6 whose channels have a mean of 1.
glm::vec3 colour_of_hue(float hue) {
  glm::vec3 colour;
  for (int channel = 0; channel < 3; ++channel) {
    float position = hue * 6 + static_cast<float>(6 - 2 * channel);
    position -= 6 * std::floor(position / 6);
    colour[channel] = 0.4f + 0.6f * std::clamp(std::abs(position - 3) - 1, 0.0f, 1.0f);
  }
  return colour * (3 / (colour.x + colour.y + colour.z));
}

// Boxes have their radius from their extents, in the proportions that they have.
void override_radius(float radius, Light& light) {
  if (light.shape != LightShape::box) {
    light.radius = radius;
    return;
  }
  const glm::dvec3 half(light.half_extents);
  const double diagonal = glm::length(half);
  // Extents that cannot be scaled are refused as they are.
  if (diagonal > 0 && std::isfinite(diagonal)) make_box(light, glm::vec3(half * (double{radius} / diagonal)));
}

void check_stage(const LightSpec& spec) {
  if (spec.spot_fraction + spec.capsule_fraction + spec.wedge_fraction + spec.box_fraction == 0) return;
  throw UsageError(
      "lights: placement 'stage' has shapes of its own, expected no spot_fraction, capsule_fraction, "
      "wedge_fraction or box_fraction");
}

// m, the s of the run's distribution of radii.
double smallest_radius(const LightSpec& spec, const Scene& scene) {
  if (spec.radius > 0) return spec.radius;
  const Placement placement = *spec.placement;
  if (placement == Placement::clumps && spec.base_size == 0 && spec.sizing == Sizing::const_overdraw)
    return clump_smallest_radius(spec.count, scene);
  double s0 = spec.base_size > 0
                  ? spec.base_size
                  : default_base_size(scene, placement, static_cast<double>(spec.radius_ratio));
  return size_for_count(s0, spec.count, spec.sizing, placement);
}

}  // namespace

const std::vector<std::string>& placement_names() {
  static const std::vector<std::string> names{"volume", "triangle", "area", "gltf",
                                              "clumps", "stage",    "room"};
  return names;
}

const std::vector<std::string>& sizing_names() {
  static const std::vector<std::string> names{"const_overdraw", "fixed_size"};
  return names;
}

const std::vector<std::string>& light_script_names() {
  static const std::vector<std::string> names{"static", "drift", "spawn", "orbit"};
  return names;
}

LightSpec completed(LightSpec spec, const LightDefaults& defaults) {
  if (!spec.placement) spec.placement = defaults.placement;
  if (!spec.script) spec.script = defaults.script;
  if (spec.radius_ratio == 0 && !has_own_radii(spec.placement)) spec.radius_ratio = defaults.radius_ratio;
  return spec;
}

std::string shape_shares_error(const LightSpec& spec) {
  const double sum = double{spec.spot_fraction} + double{spec.capsule_fraction} +
                     double{spec.wedge_fraction} + double{spec.box_fraction};
  // Shares like 0.1, 0.2, 0.3 and 0.4 add up to 1 but for rounding.
  if (sum <= 1 + 1e-6) return "";
  return fmt::format(
      "spot_fraction, capsule_fraction, wedge_fraction and box_fraction add up to {:.6g}, expected at most 1",
      sum);
}

LightSet::LightSet(const LightSpec& spec, const Scene& scene) : spec_(adapted(spec, scene)) {
  if (spec_.count > kMaxLights) {
    throw UsageError(fmt::format("lights: count is {}, expected at most {}", spec_.count, kMaxLights));
  }
  if (std::string wrong = shape_shares_error(spec_); !wrong.empty()) throw UsageError("lights: " + wrong);
  if (spec_.placement == Placement::gltf) {
    take_file_lights(scene);
  } else {
    place_lights(scene);
    account_.total = spec_.count;
  }
  account_.used = static_cast<uint32_t>(lights_.size());
}

bool LightSet::accept(const Light& light) {
  if (light.intensity == glm::vec3(0)) {
    ++account_.dark;
  } else if (const char* reason = rejection_reason(light)) {
    ++account_.rejections[reason];
  } else {
    lights_.push_back(light);
    return true;
  }
  return false;
}

void LightSet::take_file_lights(const Scene& scene) {
  if (scene.lights.empty()) {
    std::string why;
    for (const auto& [reason, count] : scene.rejected_lights)
      why += fmt::format("{}{} {}", why.empty() ? ": " : ", ", count, reason);
    throw UsageError(
        one_line(fmt::format("scene '{}': it has no lights of its own {}placement 'gltf'{}{}", scene.name,
                             why.empty() ? "for " : "that ", why.empty() ? "" : " can use", why)));
  }
  const auto limit = spec_.auto_count ? kMaxLights : spec_.count;
  const size_t count = std::min<size_t>(limit, scene.lights.size());
  account_.of_file = true;
  account_.rejections = scene.rejected_lights;
  account_.left_out = static_cast<uint32_t>(scene.lights.size() - count);
  account_.total = static_cast<uint32_t>(scene.lights.size()) + account_.rejected();
  account_.limit = limit;
  account_.limit_is_given = !spec_.auto_count;
  lights_.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Light light = scene.lights[i];
    if (spec_.radius > 0) override_radius(spec_.radius, light);
    light.intensity *= spec_.intensity;
    const bool used = accept(light);
    if (used && !scene.light_nodes.empty()) nodes_.push_back(scene.light_nodes[i]);
  }
  if (std::any_of(nodes_.begin(), nodes_.end(), [](int node) { return node >= 0; })) {
    motions_ = scene.motions;
    center_ = scene.motion_center;
  }
}

void LightSet::place_lights(const Scene& scene) {
  const uint32_t seed_hash = hash_u32(spec_.seed);
  lights_.reserve(spec_.count);
  if (spec_.placement == Placement::stage) {
    check_stage(spec_);
    const std::vector<Bounds>& rooms = rooms_of(scene, Placement::stage);
    size_ = spec_.radius > 0 ? spec_.radius : kShortestStageRange;
    for (uint32_t i = 0; i < spec_.count; ++i) {
      Light light = stage_light(rooms, seed_hash, i);
      if (spec_.radius > 0) override_radius(spec_.radius, light);
      glm::vec3 colour = colour_of_hue(LightNumbers(seed_hash, i)(LightDimension::hue));
      light.intensity *= colour * static_cast<float>(intensity_for_radius(light.radius)) * spec_.intensity;
      maybe_make_probe(LightNumbers(seed_hash, i), spec_, light);
      accept(light);
    }
    return;
  }

  size_ = static_cast<float>(smallest_radius(spec_, scene));
  if (spec_.placement == Placement::room) rooms_of(scene, Placement::room);
  if (spec_.count == 0) return;
  const LightPositions positions(spec_, scene);
  for (uint32_t i = 0; i < spec_.count; ++i) {
    LightNumbers number(seed_hash, i);
    Light light;
    light.radius = spec_.radius > 0
                       ? spec_.radius
                       : pareto_radius(number(LightDimension::radius), size_, spec_.radius_ratio);
    light.position = positions.at(i, light.radius);
    const float ball_radius = light.radius;
    give_shape(shape_of(number, spec_), number, light);
    const float lit_radius = light.shape == LightShape::box ? ball_radius : light.radius;
    glm::vec3 colour = colour_of_hue(number(LightDimension::hue));
    light.intensity = colour * static_cast<float>(intensity_for_radius(lit_radius)) * spec_.intensity;
    maybe_make_probe(number, spec_, light);
    accept(light);
  }
}

void LightSet::at(uint32_t frame, uint32_t frames, double duration, std::vector<Light>& out,
                  std::vector<uint32_t>* identity) const {
  const double time = script_time(frame, frames, duration);
  if (!motions_) return run_script(*spec_.script, spec_.seed, time, lights_, out, identity);
  std::vector<Light> moved;
  std::vector<uint32_t> numbers;  // in lights_
  move_lights(motions_->time_of(frame, frames), moved, numbers);
  run_script(*spec_.script, spec_.seed, time, moved, out, identity);
  if (!identity) return;
  for (uint32_t& number : *identity) number = numbers[number];
}

void LightSet::move_lights(double time, std::vector<Light>& moved, std::vector<uint32_t>& numbers) const {
  for (uint32_t i = 0; i < lights_.size(); ++i) {
    Light light = lights_[i];
    if (nodes_[i] >= 0) {
      glm::dmat4 world = motions_->world(static_cast<size_t>(nodes_[i]), time);
      world[3] -= glm::dvec4(center_, 0);
      if (!place_on_node(light, world) || rejection_reason(light)) continue;
    }
    moved.push_back(light);
    numbers.push_back(i);
  }
}

}  // namespace ml
