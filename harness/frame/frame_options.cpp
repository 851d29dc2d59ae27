#include "harness/frame/frame_options.h"

#include <fmt/format.h>

#include "harness/base/error.h"

namespace ml {

bool FrameOptions::fetches_texels(const gpu::DeviceInfo& info, const gpu::DeviceLimits& limits) const {
  return shading.texel_fetch.value_or(info.is_software() &&
                                      limits.texel_buffer_bytes >= limits.storage_buffer_range);
}

std::vector<ShadingOptionInfo> shading_option_table() {
  using O = FrameOptions;
  using D = gpu::Device;
  return {
      {"split_targets",
       "diffuse and specular light written apart and put together by a composite pass (shading.targets: one "
       "| split)",
       [](const O& o, const D&) { return o.shading.split_targets; }},
      {"shadow_maps",
       "depth-only pictures from the largest lights, which light nothing: work for list building to run "
       "beside (shading.shadow_maps: 0 to 16, shading.shadow_map_size)",
       [](const O& o, const D&) { return o.shading.shadow_maps != 0; }},
      {"compute_lists",
       "lists that the device builds are built on its second queue, beside the shadow maps "
       "(shading.list_queue: graphics | compute)",
       [](const O& o, const D&) { return o.shading.compute_lists; }},
      {"texel_fetch",
       "lights, trees' nodes and cells read four words at a time, through texel buffers; on software devices "
       "(shading.light_fetch: auto | storage | texel)",
       [](const O& o, const D& device) { return o.fetches_texels(device); }},
      {"test_ahead",
       "subgroups that walk together test batches of lights until one has a light that contributes, and "
       "shade then (shading.test_ahead: false | true)",
       [](const O& o, const D&) { return o.shading.test_ahead; }},
      {"long_lists",
       "passes over all lights take several an iteration: more than 28,000 lights on a driver that ends "
       "loops",
       [](const O& o, const D& device) { return o.takes_long_lists(device); }},
  };
}

std::vector<std::string> FrameOptions::names(const gpu::Device& device) const {
  std::vector<std::string> list{"omni"};
  for (const EffectInfo& info : effect_table)
    if (effects.*info.on) list.emplace_back(info.name);
  for (const ShadingOptionInfo& info : shading_option_table())
    if (info.on(*this, device)) list.emplace_back(info.name);
  return list;
}

gpu::Constants FrameOptions::constants(const gpu::Device& device) const {
  const gpu::DeviceLimits& limits = device.limits();
  const bool one_size = limits.one_subgroup_size && !tests.any_subgroup_size;
  gpu::Constants list{{"SPLIT_TARGETS", shading.split_targets, true},
                      {"TEST_AHEAD", shading.test_ahead, true},
                      {"LONG_LISTS", takes_long_lists(device), true},
                      {"TEXEL_FETCH", fetches_texels(device), true},
                      {"SUBGROUP_LANES", one_size ? limits.subgroup_size : 0, true},
                      {"POISON_SHARED", tests.poison_shared, true}};
  for (const EffectInfo& info : effect_table)
    if (info.constant) list.push_back({info.constant, effects.*info.on, true});
  return list;
}

void require_texels(const gpu::DeviceLimits& limits, const std::string& what, uint64_t bytes) {
  if (bytes > limits.texel_buffer_bytes)
    throw SystemError(fmt::format(
        "{}: {} bytes, a texel buffer of the device shows {}; shading.light_fetch=storage needs none", what,
        bytes, limits.texel_buffer_bytes));
}

}  // namespace ml
