#include "harness/gpu/memory.h"

#include <fmt/format.h>

#include <array>

#include "harness/gpu/memory_order.h"

namespace ml::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// The best kind of memory first.
std::array<uint32_t, 2> wishes(MemoryKind kind) {
  auto bits = [](vk::MemoryPropertyFlags flags) { return static_cast<uint32_t>(flags); };
  const vk::MemoryPropertyFlags mapped = Property::eHostVisible | Property::eHostCoherent;
  switch (kind) {
    case MemoryKind::upload:
      return {bits(mapped | Property::eDeviceLocal), bits(mapped)};
    case MemoryKind::readback:
      return {bits(mapped | Property::eHostCached), bits(mapped)};
    default:
      return {bits(Property::eDeviceLocal), 0};
  }
}

}  // namespace

Allocation allocate(const Device::Impl& device, const vk::MemoryRequirements& needs, MemoryKind kind,
                    const std::string& name) {
  std::vector<MemoryType> types;
  std::vector<uint64_t> heaps;
  for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
    types.push_back({static_cast<uint32_t>(device.memory.memoryTypes[i].propertyFlags),
                     device.memory.memoryTypes[i].heapIndex});
  for (uint32_t i = 0; i < device.memory.memoryHeapCount; ++i)
    heaps.push_back(device.memory.memoryHeaps[i].size);
  std::string why = "no memory of the kind that it needs is that large";
  for (uint32_t type : memory_order(types, heaps, needs.memoryTypeBits, needs.size, wishes(kind))) try {
      return {vk::raii::DeviceMemory(device.device, vk::MemoryAllocateInfo(needs.size, type)), type};
    } catch (const vk::Error& error) {
      why = error.what();
    }
  throw SystemError(fmt::format("{}: the device has no {} bytes left ({})", name, needs.size, why));
}

}  // namespace ml::gpu
