#include "harness/bench/oracle_input.h"

namespace ml {
namespace {

glm::dvec3 three(const std::vector<float>& data, size_t pixel) {
  return {data[4 * pixel], data[4 * pixel + 1], data[4 * pixel + 2]};
}

// A shape whose effect is off shines like an omni light.
bool shines(LightShape shape, const FrameOptions& options) {
  switch (shape) {
    case LightShape::omni:
      return true;
    case LightShape::spot:
      return options.effects.spots;
    case LightShape::capsule:
      return options.effects.capsules;
    case LightShape::wedge:
      return options.effects.wedges;
    case LightShape::box:
      return options.effects.boxes;
  }
  return false;
}

void set_shape(LightShape shape, const gpu_data::LightExtra& extra, OracleLight& light) {
  light.direction = extra.direction;
  light.side = extra.side;
  if (shape == LightShape::box) {
    light.box = true;
    light.half_extents = gpu_data::box_half_extents(extra);
    return;
  }
  if (has_segment(shape)) light.half_length = static_cast<double>(extra.half_length);
  if (!has_cone(shape)) return;
  light.spot = true;
  light.cone_scale = static_cast<double>(extra.cone_scale);
  light.cone_limit = static_cast<double>(extra.cone_limit);
  // Unit to the last bit only in double.
  light.direction = glm::normalize(light.direction);
}

}  // namespace

OracleFrame::OracleFrame(DeviceFrame& frame, const FrameInput& input)
    : position_(frame.read_aov(DeviceFrame::Aov::position)),
      normal_(frame.read_aov(DeviceFrame::Aov::normal)),
      albedo_(frame.read_aov(DeviceFrame::Aov::albedo)),
      material_(frame.read_aov(DeviceFrame::Aov::material)) {
  if (frame.options().effects.emission) emission_ = frame.read_aov(DeviceFrame::Aov::emission);
  for (size_t i = 0; i < input.lights.count(); ++i) {
    const gpu_data::LightCore& core = input.lights.core[i];
    OracleLight light;
    light.position = core.position;
    light.radius = static_cast<double>(core.radius);
    light.intensity = core.intensity;
    light.probe = frame.options().effects.probes && (core.id_shape & ML_LIGHT_PROBE) != 0;
    const auto shape = static_cast<LightShape>(core.id_shape >> 24);
    if (shape != LightShape::omni && shines(shape, frame.options()))
      set_shape(shape, input.lights.extra[i], light);
    lights_.push_back(light);
  }
  if (input.view.orthographic) view_direction_ = -glm::normalize(glm::dvec3(input.view.forward));
}

SurfacePoint OracleFrame::point(size_t pixel) const {
  SurfacePoint point;
  point.position = three(position_, pixel);
  // Unit to the last bit only in double: the highlight of a smooth surface shows the difference.
  point.normal = glm::normalize(three(normal_, pixel));
  point.albedo = three(albedo_, pixel);
  point.roughness = static_cast<double>(material_[4 * pixel]);
  point.metallic = static_cast<double>(material_[4 * pixel + 1]);
  if (!emission_.empty()) point.emission = three(emission_, pixel);
  point.view = view_direction_;
  return point;
}

}  // namespace ml
