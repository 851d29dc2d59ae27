// What the Vulkan loader and a layer say to each other (version 2 of its interface).
#pragma once

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace loader {

// The loader's link in the chain of a create info, or null. Info: VkLayerInstanceCreateInfo or
// VkLayerDeviceCreateInfo, with the type that it has there.
template <typename Info>
Info* link_of(const void* chain, VkStructureType type) {
  for (auto* at = static_cast<const VkBaseInStructure*>(chain); at; at = at->pNext)
    if (at->sType == type) {
      auto* info = reinterpret_cast<Info*>(const_cast<VkBaseInStructure*>(at));
      if (info->function == VK_LAYER_LINK_INFO) return info;
    }
  return nullptr;
}

// `device`: null for a layer that leaves devices alone.
inline VkResult negotiate(VkNegotiateLayerInterface* negotiation, PFN_vkGetInstanceProcAddr instance,
                          PFN_vkGetDeviceProcAddr device) {
  negotiation->loaderLayerInterfaceVersion = 2;
  negotiation->pfnGetInstanceProcAddr = instance;
  negotiation->pfnGetDeviceProcAddr = device;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

}  // namespace loader
