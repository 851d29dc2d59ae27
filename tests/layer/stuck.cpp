// A Vulkan layer for tests: a driver whose compiler does not come back. It compiles as usual until the file
// ML_STUCK_AFTER is there; the next compute pipeline makes the file ML_STUCK_MARK, and then never comes.
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/layer/loader.h"

namespace {

// Of the one instance and the one device that a program makes.
struct Calls {
  PFN_vkGetInstanceProcAddr get_instance;
  VkInstance instance;
  PFN_vkCreateDevice create_device;
  PFN_vkGetDeviceProcAddr get_device;
  PFN_vkCreateComputePipelines create_pipelines;
};
Calls calls;

std::string file_of(const char* variable) {
  const char* name = std::getenv(variable);
  return name ? name : "";
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
  auto* link =
      loader::link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  calls = {};
  calls.get_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateInstance>(calls.get_instance(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  calls.instance = *instance;
  calls.create_device = reinterpret_cast<PFN_vkCreateDevice>(calls.get_instance(*instance, "vkCreateDevice"));
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link =
      loader::link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  calls.get_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult result = calls.create_device(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  calls.create_pipelines =
      reinterpret_cast<PFN_vkCreateComputePipelines>(calls.get_device(*device, "vkCreateComputePipelines"));
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                const VkComputePipelineCreateInfo* infos,
                                                const VkAllocationCallbacks* allocator,
                                                VkPipeline* pipelines) {
  if (access(file_of("ML_STUCK_AFTER").c_str(), F_OK) == 0) {
    std::ofstream(file_of("ML_STUCK_MARK")).put('x');
    while (true) pause();
  }
  return calls.create_pipelines(device, cache, count, infos, allocator, pipelines);
}

PFN_vkVoidFunction own(const std::string& name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
  if (PFN_vkVoidFunction function = own(name)) return function;
  return calls.get_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance, const char* name) {
  if (PFN_vkVoidFunction function = own(name)) return function;
  return calls.get_instance ? calls.get_instance(calls.instance, name) : nullptr;
}

PFN_vkVoidFunction own(const std::string& name) {
  if (name == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_instance_function);
  if (name == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_device_function);
  if (name == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (name == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(create_device);
  if (name == "vkCreateComputePipelines") return reinterpret_cast<PFN_vkVoidFunction>(create_pipelines);
  return nullptr;
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  return loader::negotiate(negotiation, get_instance_function, get_device_function);
}
