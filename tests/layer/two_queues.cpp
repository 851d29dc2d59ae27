// A Vulkan layer for tests: a device of one queue family and one queue seems to have a second queue. What is
// submitted to it goes to the one there is, in the order of submission. So a software device shows what the
// validation layer, which stands above this one, has to say of submissions to two queues: owners of images,
// families of command pools, timestamps that a family does not have. What is used by a family that does not
// have it is said on stderr (owners.h).
//
// ML_TWO_QUEUES=KIND:BITS   KIND: compute, a family that does compute and no graphics, with BITS valid bits
// of timestamps; or main, a second queue of the main family.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tests/layer/loader.h"
#include "tests/layer/owners.h"

namespace {

two_queues::Owners owners;

// Dispatchable handles begin with the loader's own pointer, which is the same for all of one instance or
// device.
void* key_of(const void* handle) {
  return *static_cast<void* const*>(handle);
}

// Asked for when the instance is made: later the loader would answer with the layer on top.
struct InstanceCalls {
  VkInstance instance;
  PFN_vkGetInstanceProcAddr get;
  PFN_vkDestroyInstance destroy;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties families;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties2 families2;
};

struct SecondQueue {
  void* loader;  // where the loader expects its pointer
  VkQueue real;
};

struct DeviceCalls {
  PFN_vkGetDeviceProcAddr get;
  VkDevice device;
  SecondQueue second{};
};

std::mutex mutex;
std::map<void*, InstanceCalls> instances;
std::map<void*, DeviceCalls> devices;

InstanceCalls& of_instance(const void* handle) {
  std::lock_guard lock(mutex);
  return instances.at(key_of(handle));
}

DeviceCalls& of_device(const void* handle) {
  std::lock_guard lock(mutex);
  return devices.at(key_of(handle));
}

template <typename Function>
Function next(const DeviceCalls& calls, const char* name) {
  return reinterpret_cast<Function>(calls.get(calls.device, name));
}

struct Wish {
  bool compute = true;
  uint32_t bits = 64;
};

Wish wish() {
  const char* variable = std::getenv("ML_TWO_QUEUES");
  const std::string text = variable ? variable : "compute:64";
  const size_t colon = text.find(':');
  Wish result{text.substr(0, colon) != "main", 64};
  if (colon != text.npos) result.bits = static_cast<uint32_t>(std::stoul(text.substr(colon + 1)));
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
  auto* link =
      loader::link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  PFN_vkGetInstanceProcAddr get = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  InstanceCalls calls{*instance, get, nullptr, nullptr, nullptr};
  calls.destroy = reinterpret_cast<PFN_vkDestroyInstance>(get(*instance, "vkDestroyInstance"));
  calls.families = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
      get(*instance, "vkGetPhysicalDeviceQueueFamilyProperties"));
  calls.families2 = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties2>(
      get(*instance, "vkGetPhysicalDeviceQueueFamilyProperties2"));
  std::lock_guard lock(mutex);
  instances[key_of(*instance)] = calls;
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance, const VkAllocationCallbacks* allocator) {
  if (!instance) return;
  const PFN_vkDestroyInstance destroy = of_instance(instance).destroy;
  {
    std::lock_guard lock(mutex);
    instances.erase(key_of(instance));
  }
  destroy(instance, allocator);
}

void change(VkQueueFamilyProperties& main, VkQueueFamilyProperties& added) {
  if (!wish().compute) main.queueCount = 2;
  added = {VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT, 1, wish().bits, {1, 1, 1}};
}

// The device's families, all of them into `out` that it has space for; `at` finds the properties in an
// element.
template <typename Element, typename Get, typename At>
void families(uint32_t* count, Element* out, Get get, At at) {
  uint32_t real = 0;
  get(&real, nullptr);
  const uint32_t all = real + (wish().compute ? 1 : 0);
  if (!out) {
    *count = all;
    return;
  }
  std::vector<Element> list(real + 1, out[0]);
  get(&real, list.data());
  change(at(list[0]), at(list[real]));
  *count = std::min(*count, all);
  for (uint32_t i = 0; i < *count; ++i) at(out[i]) = at(list[i]);
}

VKAPI_ATTR void VKAPI_CALL queue_families(VkPhysicalDevice physical, uint32_t* count,
                                          VkQueueFamilyProperties* out) {
  const auto down = of_instance(physical).families;
  families(
      count, out, [&](uint32_t* n, VkQueueFamilyProperties* list) { down(physical, n, list); },
      [](VkQueueFamilyProperties& element) -> VkQueueFamilyProperties& { return element; });
}

VKAPI_ATTR void VKAPI_CALL queue_families2(VkPhysicalDevice physical, uint32_t* count,
                                           VkQueueFamilyProperties2* out) {
  const auto down = of_instance(physical).families2;
  families(
      count, out, [&](uint32_t* n, VkQueueFamilyProperties2* list) { down(physical, n, list); },
      [](VkQueueFamilyProperties2& element) -> VkQueueFamilyProperties& {
        return element.queueFamilyProperties;
      });
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link =
      loader::link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  PFN_vkGetInstanceProcAddr get_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  PFN_vkGetDeviceProcAddr get = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  // The driver has one queue.
  VkDeviceQueueCreateInfo queue = info->pQueueCreateInfos[0];
  queue.queueCount = 1;
  VkDeviceCreateInfo changed = *info;
  changed.queueCreateInfoCount = 1;
  changed.pQueueCreateInfos = &queue;
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(get_instance(of_instance(physical).instance, "vkCreateDevice"));
  const VkResult result = create(physical, &changed, allocator, device);
  if (result != VK_SUCCESS) return result;
  std::lock_guard lock(mutex);
  devices[key_of(*device)] = {get, *device};
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (!device) return;
  const auto destroy = next<PFN_vkDestroyDevice>(of_device(device), "vkDestroyDevice");
  {
    std::lock_guard lock(mutex);
    devices.erase(key_of(device));
  }
  destroy(device, allocator);
}

VKAPI_ATTR void VKAPI_CALL get_queue2(VkDevice device, const VkDeviceQueueInfo2* info, VkQueue* queue) {
  DeviceCalls& calls = of_device(device);
  next<PFN_vkGetDeviceQueue>(calls, "vkGetDeviceQueue")(device, 0, 0, queue);
  if (info->queueFamilyIndex == 0 && info->queueIndex == 0) return;
  calls.second = {key_of(*queue), *queue};
  *queue = reinterpret_cast<VkQueue>(&calls.second);
}

VKAPI_ATTR void VKAPI_CALL get_queue(VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
  const VkDeviceQueueInfo2 info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_INFO_2, nullptr, 0, family, index};
  get_queue2(device, &info, queue);
}

VkQueue real_queue(const DeviceCalls& calls, VkQueue queue) {
  return queue == reinterpret_cast<const void*>(&calls.second) ? calls.second.real : queue;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo* list,
                                      VkFence fence) {
  const DeviceCalls& calls = of_device(queue);
  return next<PFN_vkQueueSubmit>(calls, "vkQueueSubmit")(real_queue(calls, queue), count, list, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL submit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* list,
                                       VkFence fence) {
  const DeviceCalls& calls = of_device(queue);
  const uint32_t family = wish().compute && real_queue(calls, queue) != queue ? 1 : 0;
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t j = 0; j < list[i].commandBufferInfoCount; ++j)
      owners.submitted(list[i].pCommandBufferInfos[j].commandBuffer, family);
  return next<PFN_vkQueueSubmit2>(calls, "vkQueueSubmit2")(real_queue(calls, queue), count, list, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_idle(VkQueue queue) {
  const DeviceCalls& calls = of_device(queue);
  return next<PFN_vkQueueWaitIdle>(calls, "vkQueueWaitIdle")(real_queue(calls, queue));
}

VKAPI_ATTR VkResult VKAPI_CALL create_pool(VkDevice device, const VkCommandPoolCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkCommandPool* pool) {
  VkCommandPoolCreateInfo changed = *info;
  changed.queueFamilyIndex = 0;
  return next<PFN_vkCreateCommandPool>(of_device(device), "vkCreateCommandPool")(device, &changed, allocator,
                                                                                 pool);
}

// What the owners are told of, and then done.

VKAPI_ATTR VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  const VkResult result =
      next<PFN_vkCreateBuffer>(of_device(device), "vkCreateBuffer")(device, info, allocator, buffer);
  if (result == VK_SUCCESS)
    owners.created(reinterpret_cast<uint64_t>(*buffer), "a buffer", info->sharingMode);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_buffer(VkDevice device, VkBuffer buffer,
                                          const VkAllocationCallbacks* allocator) {
  owners.destroyed(reinterpret_cast<uint64_t>(buffer));
  next<PFN_vkDestroyBuffer>(of_device(device), "vkDestroyBuffer")(device, buffer, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkImage* image) {
  const VkResult result =
      next<PFN_vkCreateImage>(of_device(device), "vkCreateImage")(device, info, allocator, image);
  if (result == VK_SUCCESS) owners.created(reinterpret_cast<uint64_t>(*image), "an image", info->sharingMode);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_image(VkDevice device, VkImage image,
                                         const VkAllocationCallbacks* allocator) {
  owners.destroyed(reinterpret_cast<uint64_t>(image));
  next<PFN_vkDestroyImage>(of_device(device), "vkDestroyImage")(device, image, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL create_view(VkDevice device, const VkImageViewCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkImageView* view) {
  const VkResult result =
      next<PFN_vkCreateImageView>(of_device(device), "vkCreateImageView")(device, info, allocator, view);
  if (result == VK_SUCCESS) owners.view_created(*view, info->image);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_sets(VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                             VkDescriptorSet* sets) {
  const VkResult result =
      next<PFN_vkAllocateDescriptorSets>(of_device(device), "vkAllocateDescriptorSets")(device, info, sets);
  if (result == VK_SUCCESS) owners.sets_allocated(info->descriptorSetCount, sets);
  return result;
}

VKAPI_ATTR void VKAPI_CALL update_sets(VkDevice device, uint32_t count, const VkWriteDescriptorSet* writes,
                                       uint32_t copies, const VkCopyDescriptorSet* copied) {
  owners.sets_written(count, writes);
  next<PFN_vkUpdateDescriptorSets>(of_device(device), "vkUpdateDescriptorSets")(device, count, writes, copies,
                                                                                copied);
}

VKAPI_ATTR VkResult VKAPI_CALL begin_buffer(VkCommandBuffer buffer, const VkCommandBufferBeginInfo* info) {
  owners.begun(buffer);
  return next<PFN_vkBeginCommandBuffer>(of_device(buffer), "vkBeginCommandBuffer")(buffer, info);
}

VKAPI_ATTR void VKAPI_CALL bind_sets(VkCommandBuffer buffer, VkPipelineBindPoint point,
                                     VkPipelineLayout layout, uint32_t first, uint32_t count,
                                     const VkDescriptorSet* sets, uint32_t offsets, const uint32_t* offset) {
  for (uint32_t i = 0; i < count; ++i) owners.set_bound(buffer, sets[i]);
  next<PFN_vkCmdBindDescriptorSets>(of_device(buffer), "vkCmdBindDescriptorSets")(
      buffer, point, layout, first, count, sets, offsets, offset);
}

VKAPI_ATTR void VKAPI_CALL pipeline_barrier2(VkCommandBuffer buffer, const VkDependencyInfo* info) {
  owners.barriers(buffer, *info);
  next<PFN_vkCmdPipelineBarrier2>(of_device(buffer), "vkCmdPipelineBarrier2")(buffer, info);
}

VKAPI_ATTR void VKAPI_CALL begin_rendering(VkCommandBuffer buffer, const VkRenderingInfo* info) {
  for (uint32_t i = 0; i < info->colorAttachmentCount; ++i)
    owners.attached(buffer, info->pColorAttachments[i].imageView);
  if (info->pDepthAttachment) owners.attached(buffer, info->pDepthAttachment->imageView);
  next<PFN_vkCmdBeginRendering>(of_device(buffer), "vkCmdBeginRendering")(buffer, info);
}

PFN_vkVoidFunction own(const char* name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
  if (PFN_vkVoidFunction function = own(name)) return function;
  const DeviceCalls& calls = of_device(device);
  return calls.get(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name) {
  if (PFN_vkVoidFunction function = own(name)) return function;
  return instance ? of_instance(instance).get(instance, name) : nullptr;
}

PFN_vkVoidFunction own(const char* name) {
  static const std::map<std::string, PFN_vkVoidFunction> functions{
      {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_instance_function)},
      {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_device_function)},
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(create_instance)},
      {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(destroy_instance)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(create_device)},
      {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(destroy_device)},
      {"vkGetPhysicalDeviceQueueFamilyProperties", reinterpret_cast<PFN_vkVoidFunction>(queue_families)},
      {"vkGetPhysicalDeviceQueueFamilyProperties2", reinterpret_cast<PFN_vkVoidFunction>(queue_families2)},
      {"vkGetPhysicalDeviceQueueFamilyProperties2KHR", reinterpret_cast<PFN_vkVoidFunction>(queue_families2)},
      {"vkGetDeviceQueue", reinterpret_cast<PFN_vkVoidFunction>(get_queue)},
      {"vkGetDeviceQueue2", reinterpret_cast<PFN_vkVoidFunction>(get_queue2)},
      {"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(submit)},
      {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(submit2)},
      {"vkQueueWaitIdle", reinterpret_cast<PFN_vkVoidFunction>(wait_idle)},
      {"vkCreateCommandPool", reinterpret_cast<PFN_vkVoidFunction>(create_pool)},
      {"vkCreateBuffer", reinterpret_cast<PFN_vkVoidFunction>(create_buffer)},
      {"vkDestroyBuffer", reinterpret_cast<PFN_vkVoidFunction>(destroy_buffer)},
      {"vkCreateImage", reinterpret_cast<PFN_vkVoidFunction>(create_image)},
      {"vkDestroyImage", reinterpret_cast<PFN_vkVoidFunction>(destroy_image)},
      {"vkCreateImageView", reinterpret_cast<PFN_vkVoidFunction>(create_view)},
      {"vkAllocateDescriptorSets", reinterpret_cast<PFN_vkVoidFunction>(allocate_sets)},
      {"vkUpdateDescriptorSets", reinterpret_cast<PFN_vkVoidFunction>(update_sets)},
      {"vkBeginCommandBuffer", reinterpret_cast<PFN_vkVoidFunction>(begin_buffer)},
      {"vkCmdBindDescriptorSets", reinterpret_cast<PFN_vkVoidFunction>(bind_sets)},
      {"vkCmdPipelineBarrier2", reinterpret_cast<PFN_vkVoidFunction>(pipeline_barrier2)},
      {"vkCmdBeginRendering", reinterpret_cast<PFN_vkVoidFunction>(begin_rendering)}};
  auto found = functions.find(name);
  return found == functions.end() ? nullptr : found->second;
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  return loader::negotiate(negotiation, get_instance_function, get_device_function);
}
