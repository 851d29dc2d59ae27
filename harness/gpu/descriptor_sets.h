// Private to this room.
#pragma once

#include "harness/gpu/vulkan.h"

namespace ml::gpu {

// Descriptor sets of one submission: pools are added as needed and all reset together.
class DescriptorSets {
 public:
  vk::DescriptorSet allocate(Device::Impl& device, vk::DescriptorSetLayout layout) {
    for (;; ++current_) {
      if (current_ == pools_.size()) pools_.push_back(make_pool(device));
      vk::DescriptorSetAllocateInfo info(*pools_[current_], layout);
      VkDescriptorSet set = VK_NULL_HANDLE;
      auto plain = static_cast<VkDescriptorSetAllocateInfo>(info);
      VkResult result = device.device.getDispatcher()->vkAllocateDescriptorSets(
          static_cast<VkDevice>(*device.device), &plain, &set);
      if (result == VK_SUCCESS) return set;
      if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL)
        throw SystemError("the device has no memory for descriptors");
    }
  }
  void reset() {
    for (vk::raii::DescriptorPool& pool : pools_) pool.reset();
    current_ = 0;
  }

 private:
  static vk::raii::DescriptorPool make_pool(Device::Impl& device) {
    constexpr uint32_t sets = 256;
    using Type = vk::DescriptorType;
    std::array sizes{vk::DescriptorPoolSize(Type::eStorageBuffer, sets * 8),
                     vk::DescriptorPoolSize(Type::eUniformBuffer, sets * 2),
                     vk::DescriptorPoolSize(Type::eStorageImage, sets * 8),
                     vk::DescriptorPoolSize(Type::eCombinedImageSampler, sets * 4),
                     vk::DescriptorPoolSize(Type::eUniformTexelBuffer, sets * 4)};
    return {device.device, vk::DescriptorPoolCreateInfo({}, sets, sizes)};
  }
  std::vector<vk::raii::DescriptorPool> pools_;
  size_t current_ = 0;
};

}  // namespace ml::gpu
