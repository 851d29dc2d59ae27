// The pictures of one resolution on the device.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "harness/gpu/resources.h"

namespace ml {

// G-buffer and HDR result.
struct FrameTargets {
  gpu::Image depth, surface, result;
  // Which triangle a pixel shows, from 1, where it is lit forward; else 0. Only where something is.
  std::optional<gpu::Image> forward;
  // Light that the albedo multiplies, and the rest: only where the shading pass writes them apart.
  std::optional<gpu::Image> diffuse, specular;
  // W/m^2/sr that the surface gives by itself: only where one does.
  std::optional<gpu::Image> emission;
  FrameTargets(gpu::Device& device, uint32_t width, uint32_t height, bool with_forward = false,
               bool split = false, bool with_emission = false)
      : depth(device, width, height, gpu::Format::d32_float, gpu::ImageUse::attachment, "depth"),
        surface(device, width, height, gpu::Format::rg32_uint, gpu::ImageUse::attachment, "surface"),
        result(device, width, height, gpu::Format::rgba32_float,
               with_forward ? gpu::ImageUse::storage_attachment : gpu::ImageUse::storage, "result") {
    if (with_forward)
      forward.emplace(device, width, height, gpu::Format::r32_uint, gpu::ImageUse::attachment, "forward");
    if (with_emission)
      emission.emplace(device, width, height, gpu::Format::rgba32_float, gpu::ImageUse::attachment,
                       "emission");
    if (!split) return;
    diffuse.emplace(device, width, height, gpu::Format::rgba32_float, gpu::ImageUse::storage, "diffuse");
    specular.emplace(device, width, height, gpu::Format::rgba32_float, gpu::ImageUse::storage, "specular");
  }
  uint32_t width() const { return depth.width(); }
  uint32_t height() const { return depth.height(); }
};

// What the counting variant of the shading loop writes, one number a pixel.
struct CounterTargets {
  gpu::Image listed, tested, contributing, nodes, hash, traversal;
  CounterTargets(gpu::Device& device, uint32_t width, uint32_t height)
      : listed(counter(device, width, height, "listed")),
        tested(counter(device, width, height, "tested")),
        contributing(counter(device, width, height, "contributing")),
        nodes(counter(device, width, height, "nodes")),
        hash(counter(device, width, height, "hash")),
        traversal(counter(device, width, height, "traversal")) {}
  // As shaders bind them.
  std::array<std::pair<const char*, const gpu::Image*>, 6> named() const {
    return {{{"Listed", &listed},
             {"Tested", &tested},
             {"Contributing", &contributing},
             {"Nodes", &nodes},
             {"Hash", &hash},
             {"Traversal", &traversal}}};
  }

 private:
  static gpu::Image counter(gpu::Device& device, uint32_t width, uint32_t height, const char* name) {
    return {device, width, height, gpu::Format::r32_uint, gpu::ImageUse::storage, name};
  }
};

}  // namespace ml
