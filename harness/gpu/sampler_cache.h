// Private to this room: the samplers that a device's images are read with. A device may have few of them
// (4000 are sure), and images ask for the same ones again and again.
#pragma once

#include <map>
#include <mutex>
#include <utility>
#include <vulkan/vulkan_raii.hpp>

#include "harness/gpu/resources.h"

namespace ml::gpu {

// Safe to use from several threads.
class SamplerCache {
 public:
  // For an image of so many levels. Lives as long as the cache.
  vk::Sampler get(const vk::raii::Device& device, const Sampling& sampling, uint32_t levels);

 private:
  std::mutex mutex_;
  std::map<std::pair<Sampling, uint32_t>, vk::raii::Sampler> samplers_;
};

}  // namespace ml::gpu
