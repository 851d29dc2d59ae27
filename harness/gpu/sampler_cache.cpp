#include "harness/gpu/sampler_cache.h"

namespace ml::gpu {
namespace {

vk::SamplerAddressMode address_mode(Sampling::Edge edge) {
  switch (edge) {
    case Sampling::Edge::mirrored_repeat:
      return vk::SamplerAddressMode::eMirroredRepeat;
    case Sampling::Edge::clamp:
      return vk::SamplerAddressMode::eClampToEdge;
    default:
      return vk::SamplerAddressMode::eRepeat;
  }
}

vk::SamplerCreateInfo sampler_info(const Sampling& sampling, uint32_t levels) {
  auto filter = [](bool linear) { return linear ? vk::Filter::eLinear : vk::Filter::eNearest; };
  vk::SamplerCreateInfo info(
      {}, filter(sampling.magnify_linear), filter(sampling.minify_linear),
      sampling.levels_linear ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
      address_mode(sampling.u), address_mode(sampling.v));
  // With one level the level of detail still chooses between the two filters, which it cannot when it is held
  // at 0 (Vulkan 1.3, VkSamplerCreateInfo: how OpenGL's filters without levels are said).
  if (levels > 1)
    info.maxLod = static_cast<float>(levels);
  else if (sampling.magnify_linear != sampling.minify_linear)
    info.maxLod = 0.25f;
  if (sampling.compare != Sampling::Compare::none) {
    info.compareEnable = VK_TRUE;
    info.compareOp = sampling.compare == Sampling::Compare::greater_or_equal ? vk::CompareOp::eGreaterOrEqual
                                                                             : vk::CompareOp::eLessOrEqual;
  }
  return info;
}

}  // namespace

vk::Sampler SamplerCache::get(const vk::raii::Device& device, const Sampling& sampling, uint32_t levels) {
  std::lock_guard lock(mutex_);
  const std::pair key(sampling, levels);
  auto found = samplers_.find(key);
  if (found == samplers_.end())
    found = samplers_.emplace(key, vk::raii::Sampler(device, sampler_info(sampling, levels))).first;
  return *found->second;
}

}  // namespace ml::gpu
