// Which effects a frame has: what the content calls for, and what the configuration asks of the shading
// passes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/gpu/device.h"
#include "harness/gpu/program.h"

namespace ml {

// Which effects the content calls for; compiled in by specialization constants.
struct Effects {
  bool spots = false;
  bool capsules = false;
  bool wedges = false;
  bool boxes = false;
  bool probes = false;
  bool specular = true;
  bool alpha_mask = false;
  bool forward = false;          // materials that are lit in a pass of their own
  bool clip_far = false;         // the camera has a far plane that cuts the level
  bool motion = false;           // nodes carry meshes
  bool material_detail = false;  // vertex colours, metallic-roughness textures, normal maps
  bool emission = false;         // surfaces that give light by themselves, on top of all lights
  // The shading pass writes diffuse and specular light apart (shading.targets: split), not a property of the
  // content.
  bool split_targets = false;
  // Nor are these: so many shadow maps of so many px are drawn in a frame, which light nothing yet
  // (shading.shadow_maps); lists that the GPU builds are built on the second queue beside them
  // (shading.list_queue: compute).
  uint32_t shadow_maps = 0, shadow_map_size = 1024;
  bool compute_lists = false;
  // Light data, trees' nodes and cells come through texel buffers (shading.light_fetch); none: as is known to
  // be faster on the kind of device.
  std::optional<bool> texel_fetch = std::nullopt;
  bool fetches_texels(const gpu::DeviceInfo& info, const gpu::DeviceLimits& limits) const;
  bool fetches_texels(const gpu::Device& device) const {
    return fetches_texels(device.info(), device.limits());
  }
  // Subgroups that walk together test batches of lights until one contributes, and shade then
  // (shading.test_ahead).
  bool test_ahead = false;
  // There are more than max_lights_of_short_passes lights (harness/frame/shading_loops.h): on drivers that
  // end loops passes over all lights take several of them an iteration. Shading loops go by what a frame's
  // pixels walk (ShadedAlgorithm).
  bool long_lists = true;
  bool takes_long_lists(const gpu::Device& device) const {
    return long_lists && device.limits().loop_iterations != 0;
  }
  // Programs are made as for devices whose subgroups are large, or not all of one size: tests ask for it.
  bool any_subgroup_size = false;
  bool poison_shared = false;  // shared memory begins as garbage: tests ask for it
  bool long_walks = false;     // shading loops for long walks in every frame: tests ask for them
  bool operator==(const Effects&) const = default;
  // Those that are on, "omni" first.
  std::vector<std::string> names(const gpu::Device& device) const;
  // As FrameLightStorage::fill takes them: shapes that are off shine like omni lights, probe lights like
  // direct ones.
  uint32_t shapes() const {
    return 1u | (spots ? 2u : 0u) | (capsules ? 4u : 0u) | (wedges ? 8u : 0u) | (boxes ? 16u : 0u) |
           (probes ? 32u : 0u);
  }
  // Their specialization constants (shaders/constants.glsl), offered to any program.
  gpu::Constants constants(const gpu::Device& device) const;
};

// Throws SystemError when texel buffers of the device do not show so many bytes of `what`. To be asked where
// texels are fetched.
void require_texels(const gpu::DeviceLimits& limits, const std::string& what, uint64_t bytes);

}  // namespace ml
