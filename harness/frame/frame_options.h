// What a frame's programs are made for: the effects that its content calls for, how the configuration wants
// it shaded, and what tests ask for on top.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/gpu/device.h"
#include "harness/gpu/program.h"
#include "harness/scene/effects.h"

namespace ml {

// `shading` of a configuration: no property of the content.
struct ShadingOptions {
  // The shading pass writes diffuse and specular light apart (shading.targets: split).
  bool split_targets = false;
  // So many shadow maps of so many px are drawn in a frame, which light nothing yet (shading.shadow_maps).
  uint32_t shadow_maps = 0, shadow_map_size = 1024;
  // Lists that the GPU builds are built on the second queue beside them (shading.list_queue: compute).
  bool compute_lists = false;
  // Light data, trees' nodes and cells come through texel buffers (shading.light_fetch); none: as is known to
  // be faster on the kind of device.
  std::optional<bool> texel_fetch = std::nullopt;
  // Subgroups that walk together test batches of lights until one contributes, and shade then
  // (shading.test_ahead).
  bool test_ahead = false;
  bool operator==(const ShadingOptions&) const = default;
};

// What is never on outside tests.
struct TestHooks {
  // Programs are made as for devices whose subgroups are large, or not all of one size.
  bool any_subgroup_size = false;
  bool poison_shared = false;  // shared memory begins as garbage
  bool long_walks = false;     // shading loops for long walks in every frame
  bool operator==(const TestHooks&) const = default;
};

struct FrameOptions {
  Effects effects = {};
  ShadingOptions shading = {};
  // There are more than max_lights_of_short_passes lights (harness/frame/shading_loops.h): on drivers that
  // end loops passes over all lights take several of them an iteration. Shading loops go by what a frame's
  // pixels walk (ShadedAlgorithm).
  bool many_lights = true;
  TestHooks tests = {};
  bool operator==(const FrameOptions&) const = default;

  bool fetches_texels(const gpu::DeviceInfo& info, const gpu::DeviceLimits& limits) const;
  bool fetches_texels(const gpu::Device& device) const {
    return fetches_texels(device.info(), device.limits());
  }
  bool takes_long_lists(const gpu::Device& device) const {
    return many_lights && device.limits().loop_iterations != 0;
  }
  // What is on, as a result's `effects` has it; "omni" first.
  std::vector<std::string> names(const gpu::Device& device) const;
  // The specialization constants of all of it (shaders/constants.glsl), offered to any program.
  gpu::Constants constants(const gpu::Device& device) const;
};

// What names() may have beside effects: ways of shading.
struct ShadingOptionInfo {
  const char* name;
  const char* help;
  bool (*on)(const FrameOptions&, const gpu::Device&);
};
std::vector<ShadingOptionInfo> shading_option_table();

// Throws SystemError when texel buffers of the device do not show so many bytes of `what`. To be asked where
// texels are fetched.
void require_texels(const gpu::DeviceLimits& limits, const std::string& what, uint64_t bytes);

}  // namespace ml
