#include "harness/frame/frame_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/check.h"

namespace ml {
namespace {

// Floats read past the end by vector code: 16 lanes of 4 bytes.
constexpr size_t padding = 16;

// The smallest float that is not below.
float rounded_up(double value) {
  auto result = static_cast<float>(value);
  return double{result} < value ? std::nextafter(result, std::numeric_limits<float>::infinity()) : result;
}

// Of the ball around the position that holds the light's volume.
float bounding_radius(const Light& light) {
  // The axes are rounded to float, which moves the ends of a segment and the corners of a box a little.
  constexpr double rounding = 1 + 1e-6;
  if (has_segment(light.shape) && light.half_length > 0)
    return rounded_up((double{light.half_length} + double{light.radius}) * rounding);
  if (light.shape == LightShape::box)
    return rounded_up(std::max(glm::length(glm::dvec3(light.half_extents)), double{light.radius}) * rounding);
  return light.radius;
}

void set_cone(const Light& light, gpu_data::LightExtra& extra) {
  extra.direction = glm::normalize(glm::dvec3(light.direction));
  double inner = std::cos(static_cast<double>(light.inner_angle)),
         outer = std::cos(static_cast<double>(light.outer_angle));
  // A cone without a soft edge still needs a finite slope.
  double scale = 1.0 / std::max(inner - outer, 1e-6);
  extra.cone_scale = static_cast<float>(scale);
  const double chord = 2 * std::sin(0.5 * static_cast<double>(light.outer_angle));
  extra.cone_limit = static_cast<float>(0.5 * chord * chord);
  extra.cos_outer = static_cast<float>(outer);
}

gpu_data::LightExtra extra_of(const Light& light) {
  gpu_data::LightExtra extra{};
  extra.cone_scale = 1;
  extra.cone_limit = 4;
  extra.cos_outer = -2;
  extra.bound_radius = bounding_radius(light);
  if (has_cone(light.shape)) set_cone(light, extra);
  if (has_segment(light.shape)) extra.half_length = light.half_length;
  if (light.shape == LightShape::omni || light.shape == LightShape::spot) return extra;
  // Accepted axes are unit and at right angles to about 1e-3: here to the last bit but one.
  glm::dvec3 side = glm::normalize(glm::dvec3(light.side)), front(light.direction);
  if (light.shape == LightShape::capsule) extra.side = side;
  if (light.shape != LightShape::wedge && light.shape != LightShape::box) return extra;
  front = glm::normalize(front);
  extra.side = glm::normalize(side - glm::dot(side, front) * front);
  if (light.shape == LightShape::box) {
    extra.direction = front;
    extra.half_length = light.half_extents.x;
    extra.cone_scale = light.half_extents.y;
    extra.cone_limit = light.half_extents.z;
  }
  return extra;
}

}  // namespace

gpu_data::ViewData view_data(const Camera& camera, uint32_t width, uint32_t height, uint32_t light_count) {
  const Projection& p = camera.projection;
  gpu_data::ViewData view{};
  view.right = camera.right;
  view.up = camera.up;
  view.forward = camera.forward;
  view.camera = camera.position;
  view.left_edge = p.left;
  view.right_edge = p.right;
  view.bottom_edge = p.bottom;
  view.top_edge = p.top;
  view.resolution = {width, height};
  view.near = p.near;
  view.far = p.far;
  view.clip_far = p.clips_far ? p.far : 0;
  view.orthographic = p.kind == ProjectionKind::orthographic;
  view.light_count = light_count;
  return view;
}

void FrameLightStorage::fill(const std::vector<Light>& lights, const glm::vec3& camera, uint32_t shapes) {
  ML_CHECK_LE(lights.size(), gpu_data::uint{ML_LIGHT_ID_MASK} + 1);
  count_ = lights.size();
  for (std::vector<float>* column : {&x_, &y_, &z_, &radius_}) column->resize(count_ + padding);
  core_.resize(count_);
  auto is_omni = [shapes](const Light& light) {
    return light.shape == LightShape::omni || !(shapes >> static_cast<uint32_t>(light.shape) & 1);
  };
  const bool needs_extra = !std::all_of(lights.begin(), lights.end(), is_omni);
  extra_.resize(needs_extra ? count_ : 0);
  const glm::dvec3 eye(camera);
  for (size_t i = 0; i < count_; ++i) {
    const Light& light = lights[i];
    glm::vec3 position(light.position - eye);
    x_[i] = position.x;
    y_[i] = position.y;
    z_[i] = position.z;
    const bool omni = is_omni(light), probe = light.probe && (shapes & probe_lights_bit);
    radius_[i] = omni ? light.radius : bounding_radius(light);
    core_[i] = {position, light.radius, light.intensity,
                static_cast<uint32_t>(i) | (probe ? ML_LIGHT_PROBE : 0u) |
                    (omni ? ML_SHAPE_OMNI : static_cast<uint32_t>(light.shape)) << 24};
    if (!needs_extra) continue;
    Light shining = light;
    if (omni) shining.shape = LightShape::omni;
    extra_[i] = extra_of(shining);
  }
}

FrameLights FrameLightStorage::lights() const {
  FrameLights lights;
  lights.x = std::span(x_).first(count_);
  lights.y = std::span(y_).first(count_);
  lights.z = std::span(z_).first(count_);
  lights.radius = std::span(radius_).first(count_);
  lights.core = core_;
  lights.extra = extra_;
  return lights;
}

FrameSequence::FrameSequence(const Scene& scene, const LightSet& lights, const CameraPath& path,
                             uint32_t frames, uint32_t width, uint32_t height, Threads& threads,
                             uint32_t shapes)
    : scene_(scene),
      set_(lights),
      path_(path),
      frames_(frames),
      width_(width),
      height_(height),
      shapes_(shapes) {
  input_.threads = &threads;
}

const FrameInput& FrameSequence::at(uint32_t index) {
  ML_CHECK_LT(index, frames_);
  camera_ = path_.sample(index, frames_, width_, height_, scene_.near, scene_.far);
  set_.at(index, frames_, path_.duration(), active_, &identity_);
  storage_.fill(active_, camera_.position, shapes_);
  const bool follows = seen_ && index == input_.index + 1 && !path_.cuts(index, frames_);
  const gpu_data::ViewData before = input_.view;
  if (seen_ && index == input_.index)
    input_.step = Step::same;
  else
    input_.step = follows ? Step::next : Step::first;
  seen_ = true;
  input_.index = index;
  input_.time = scene_.motions ? scene_.motions->time_of(index, frames_) : 0;
  input_.view = view_data(camera_, width_, height_, static_cast<uint32_t>(active_.size()));
  if (input_.step == Step::next) input_.previous_view = before;
  if (input_.step == Step::first) input_.previous_view = input_.view;
  input_.lights = storage_.lights();
  input_.lights.identity = identity_;
  return input_;
}

}  // namespace ml
