// The tables of the sections: one line per key.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "harness/base/json_node.h"
#include "harness/config/config.h"
#include "scenes/load_scene.h"

namespace ml {

template <typename Spec>
struct Field {
  const char* key;
  void (*read)(const Node&, Spec&);
  nlohmann::json (*write)(const Spec&);  // null: does not apply
};

std::span<const Field<SceneSpec>> scene_fields();
std::span<const Field<LightSpec>> light_fields();
std::span<const Field<CameraSpec>> camera_fields();
std::span<const Field<Effects>> effects_fields();
std::span<const Field<ShadingSpec>> shading_fields();
std::span<const Field<MeasureSpec>> measure_fields();
std::span<const Field<OutputSpec>> output_fields();

// What a configuration calls the scene: its name, or the stem of its file.
std::string scene_label(const SceneSpec& scene);

void read_resolution(const Node& node, Setup& setup);

}  // namespace ml
