#include "harness/frame/effects.h"

#include <fmt/format.h>

#include "harness/base/error.h"

namespace ml {

bool Effects::fetches_texels(const gpu::DeviceInfo& info, const gpu::DeviceLimits& limits) const {
  return texel_fetch.value_or(info.is_software() && limits.texel_buffer_bytes >= limits.storage_buffer_range);
}

std::vector<std::string> Effects::names(const gpu::Device& device) const {
  std::vector<std::string> list{"omni"};
  if (spots) list.emplace_back("spot");
  if (capsules) list.emplace_back("capsule");
  if (wedges) list.emplace_back("wedge");
  if (boxes) list.emplace_back("box");
  if (probes) list.emplace_back("probe");
  if (specular) list.emplace_back("specular");
  if (alpha_mask) list.emplace_back("alpha_mask");
  if (forward) list.emplace_back("forward");
  if (clip_far) list.emplace_back("clip_far");
  if (motion) list.emplace_back("motion");
  if (material_detail) list.emplace_back("material_detail");
  if (emission) list.emplace_back("emission");
  if (split_targets) list.emplace_back("split_targets");
  if (shadow_maps) list.emplace_back("shadow_maps");
  if (compute_lists) list.emplace_back("compute_lists");
  if (fetches_texels(device)) list.emplace_back("texel_fetch");
  if (test_ahead) list.emplace_back("test_ahead");
  if (takes_long_lists(device)) list.emplace_back("long_lists");
  return list;
}

gpu::Constants Effects::constants(const gpu::Device& device) const {
  const gpu::DeviceLimits& limits = device.limits();
  return {{"EFFECT_SPOTS", spots, true},
          {"EFFECT_CAPSULES", capsules, true},
          {"EFFECT_WEDGES", wedges, true},
          {"EFFECT_BOXES", boxes, true},
          {"EFFECT_PROBES", probes, true},
          {"EFFECT_SPECULAR", specular, true},
          {"EFFECT_EMISSION", emission, true},
          {"LONG_LISTS", takes_long_lists(device), true},
          {"SUBGROUP_LANES", limits.one_subgroup_size && !any_subgroup_size ? limits.subgroup_size : 0, true},
          {"TEXEL_FETCH", fetches_texels(device), true},
          {"TEST_AHEAD", test_ahead, true},
          {"POISON_SHARED", poison_shared, true}};
}

void require_texels(const gpu::DeviceLimits& limits, const std::string& what, uint64_t bytes) {
  if (bytes > limits.texel_buffer_bytes)
    throw SystemError(fmt::format(
        "{}: {} bytes, a texel buffer of the device shows {}; shading.light_fetch=storage needs none", what,
        bytes, limits.texel_buffer_bytes));
}

}  // namespace ml
