// A Vulkan layer for tests: a device seems to lack something that manylights needs. It only changes what the
// device says of itself, so it is of use where no device is made.
//
// ML_LACKS=version | scalarBlockLayout | synchronization2 | dynamicRendering | shuffle | stage
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <string>

#include "tests/layer/loader.h"

namespace {

// Of the one instance that a program makes. Asked for when it is made: later the loader would answer with the
// layer on top.
struct Calls {
  PFN_vkGetInstanceProcAddr get;
  VkInstance instance;
  PFN_vkGetPhysicalDeviceProperties properties;
  PFN_vkGetPhysicalDeviceProperties2 properties2;
  PFN_vkGetPhysicalDeviceFeatures2 features2;
};
Calls calls;

template <typename Function>
void ask(Function& function, const char* name) {
  function = reinterpret_cast<Function>(calls.get(calls.instance, name));
}

bool lacks(const char* what) {
  const char* variable = std::getenv("ML_LACKS");
  return variable && variable == std::string(what);
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
  auto* link =
      loader::link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  calls = {};
  calls.get = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  PFN_vkCreateInstance create;
  ask(create, "vkCreateInstance");
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  calls.instance = *instance;
  ask(calls.properties, "vkGetPhysicalDeviceProperties");
  ask(calls.properties2, "vkGetPhysicalDeviceProperties2");
  ask(calls.features2, "vkGetPhysicalDeviceFeatures2");
  return result;
}

void age(VkPhysicalDeviceProperties& properties) {
  if (lacks("version")) properties.apiVersion = VK_MAKE_API_VERSION(0, 1, 2, 0);
}

VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* out) {
  calls.properties(physical, out);
  age(*out);
}

VKAPI_ATTR void VKAPI_CALL properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* out) {
  calls.properties2(physical, out);
  age(out->properties);
  for (auto* at = static_cast<VkBaseOutStructure*>(out->pNext); at; at = at->pNext) {
    if (at->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES) continue;
    auto* subgroups = reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(at);
    if (lacks("shuffle"))
      subgroups->supportedOperations &= ~static_cast<VkSubgroupFeatureFlags>(VK_SUBGROUP_FEATURE_SHUFFLE_BIT);
    if (lacks("stage")) subgroups->supportedStages = VK_SHADER_STAGE_FRAGMENT_BIT;
  }
}

VKAPI_ATTR void VKAPI_CALL features2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* out) {
  calls.features2(physical, out);
  for (auto* at = static_cast<VkBaseOutStructure*>(out->pNext); at; at = at->pNext) {
    if (at->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES && lacks("scalarBlockLayout"))
      reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(at)->scalarBlockLayout = VK_FALSE;
    if (at->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) continue;
    auto* features = reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(at);
    if (lacks("synchronization2")) features->synchronization2 = VK_FALSE;
    if (lacks("dynamicRendering")) features->dynamicRendering = VK_FALSE;
  }
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance, const char* name) {
  const std::string asked = name;
  if (asked == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_instance_function);
  if (asked == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (asked == "vkGetPhysicalDeviceProperties") return reinterpret_cast<PFN_vkVoidFunction>(properties);
  if (asked == "vkGetPhysicalDeviceProperties2") return reinterpret_cast<PFN_vkVoidFunction>(properties2);
  if (asked == "vkGetPhysicalDeviceFeatures2") return reinterpret_cast<PFN_vkVoidFunction>(features2);
  return calls.get ? calls.get(calls.instance, name) : nullptr;
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  return loader::negotiate(negotiation, get_instance_function, nullptr);
}
