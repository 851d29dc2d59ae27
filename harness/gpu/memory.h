// Private to this room: memory for buffers and images.
#pragma once

#include "harness/gpu/vulkan.h"

namespace ml::gpu {

struct Allocation {
  vk::raii::DeviceMemory memory;
  uint32_t type;
};

// Out of the first heap that has space: those of the best kind come first. Throws SystemError naming `name`
// when none has.
Allocation allocate(const Device::Impl& device, const vk::MemoryRequirements& needs, MemoryKind kind,
                    const std::string& name);

}  // namespace ml::gpu
