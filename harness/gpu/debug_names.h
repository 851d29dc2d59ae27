// Private to this room: names of objects, and of stretches of work, for debuggers and in messages of the
// validation layer. Where nothing reads them (Device::Impl::names) they cost a branch.
#pragma once

#include <string>

#include "harness/gpu/vulkan.h"

namespace ml::gpu {

// `object`: one of vk::raii's.
template <typename Object>
void set_name(const Device::Impl& device, const Object& object, const std::string& name) {
  if (!device.names) return;
  const auto handle = static_cast<typename Object::CType>(*object);
  device.device.setDebugUtilsObjectNameEXT(
      vk::DebugUtilsObjectNameInfoEXT(Object::objectType, reinterpret_cast<uint64_t>(handle), name.c_str()));
}

inline void begin_label(const Device::Impl& device, const vk::raii::CommandBuffer& commands,
                        std::string_view name) {
  if (!device.names) return;
  const std::string text(name);
  commands.beginDebugUtilsLabelEXT(vk::DebugUtilsLabelEXT(text.c_str()));
}
inline void end_label(const Device::Impl& device, const vk::raii::CommandBuffer& commands) {
  if (device.names) commands.endDebugUtilsLabelEXT();
}

}  // namespace ml::gpu
