#include "harness/scene/effects.h"

#include <algorithm>

namespace ml {
namespace {

bool any_light(const Content& content, LightShape shape) {
  return std::ranges::any_of(content.lights, [&](const Light& light) { return light.shape == shape; });
}

template <typename Is>
bool any_drawn(const Content& content, Is is) {
  // Where no triangle has a material it calls for nothing.
  return std::ranges::any_of(content.scene.draws, [&](const Draw& draw) {
    return draw.index_count > 0 && is(content.scene.materials[draw.material]);
  });
}

}  // namespace

bool has_normal_map(const Material& material) {
  return material.normal_texture >= 0 && material.normal_scale != 0;
}

namespace content {

bool has_spots(const Content& c) {
  return any_light(c, LightShape::spot);
}
bool has_capsules(const Content& c) {
  return any_light(c, LightShape::capsule);
}
bool has_wedges(const Content& c) {
  return any_light(c, LightShape::wedge);
}
bool has_boxes(const Content& c) {
  return any_light(c, LightShape::box);
}
bool has_probes(const Content& c) {
  return std::ranges::any_of(c.lights, [](const Light& light) { return light.probe; });
}
bool has_surfaces(const Content&) {
  return true;
}
bool has_masked_materials(const Content& c) {
  return any_drawn(c, [](const Material& material) { return material.alpha_mode == AlphaMode::mask; });
}
bool has_forward_materials(const Content& c) {
  return any_drawn(c, [](const Material& material) { return material.forward; });
}
bool has_material_detail(const Content& c) {
  return !c.scene.details.colors.empty() || any_drawn(c, [](const Material& material) {
    return material.metallic_roughness_texture >= 0 || has_normal_map(material);
  });
}
bool has_emission(const Content& c) {
  return any_drawn(c, [](const Material& material) { return material.emission != glm::vec3(0); });
}
bool has_far_plane(const Content& c) {
  return c.path.clips_far;
}
bool has_moving_meshes(const Content& c) {
  return !c.scene.draw_motions.empty();
}

}  // namespace content

Effects effects_of(const Content& content, const Effects& allowed) {
  Effects effects;
  for (const EffectInfo& info : effect_table) effects.*info.on = allowed.*info.on && info.called_for(content);
  return effects;
}

Effects all_effects() {
  Effects all;
  for (const EffectInfo& info : effect_table) all.*info.on = true;
  return all;
}

}  // namespace ml
