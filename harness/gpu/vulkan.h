// Private to this room: the Vulkan objects behind its classes. Precompiled, because vulkan_raii.hpp costs
// seconds a file.
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "harness/base/error.h"
#include "harness/gpu/commands.h"
#include "harness/gpu/device.h"
#include "harness/gpu/program.h"
#include "harness/gpu/program_cache.h"
#include "harness/gpu/resources.h"
#include "harness/gpu/sampler_cache.h"
#include "harness/gpu/specialization.h"

namespace ml::gpu {

// Messages of the validation layer; filled from any thread.
struct MessageLog {
  std::mutex mutex;
  std::vector<std::string> messages;
  // While passes are recorded whose writes are said to be apart (Commands::unordered): the layer sees whole
  // images and buffers, and would call every two of them a hazard.
  bool writes_apart = false;
};

struct QueueSlot {
  vk::raii::Queue queue = nullptr;
  uint32_t family = 0;
};

struct Device::Impl {
  vk::raii::Context context;
  vk::raii::Instance instance = nullptr;
  MessageLog log;
  vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
  vk::raii::PhysicalDevice physical = nullptr;
  vk::raii::Device device = nullptr;
  // `second` is `main` once more where the device has one queue.
  QueueSlot main, second;
  bool two_families() const { return main.family != second.family; }
  vk::PhysicalDeviceMemoryProperties memory;
  DeviceInfo info;
  DeviceLimits limits;
  bool validation = false, poison = false;
  bool names = false;  // something reads the names of objects (debug_names.h)
  SamplerCache samplers;
  ProgramCache<ComputeProgram::Impl> compute_programs;
  ProgramCache<RasterProgram::Impl> raster_programs;
};

// A texel of four words.
inline constexpr size_t quad_bytes = 16;

struct Buffer::Impl {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Buffer buffer = nullptr;
  vk::raii::BufferView quads = nullptr;  // as texels of four words; none for readback
  std::span<std::byte> mapped;
  bool device_local = false, cached = false;
  MemoryKind kind = MemoryKind::device;
};

struct Image::Impl {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Image image = nullptr;
  vk::raii::ImageView view = nullptr;                   // of all levels
  std::map<uint32_t, vk::raii::ImageView> level_views;  // made when one is first bound
  uint32_t levels = 1;
  vk::Sampler sampler;  // the device's
  vk::Format format{};
  vk::FormatFeatureFlags2 features;
  vk::ImageAspectFlags aspect;
  // As of the last command recorded.
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;

  vk::raii::ImageView view_of(const Device::Impl& device, uint32_t first, uint32_t count) const;
  vk::ImageView level_view(const Device::Impl& device, uint32_t level);
};

// Who may use a resource. Buffers belong to both families where there are two: no device is known to treat
// such a buffer worse. Images belong to one, and are handed over (Commands::fork), because a device may give
// up the compression of an image that two families share, and the g-buffer is to be the same wherever lists
// are built.
struct Sharing {
  explicit Sharing(const Device::Impl& device) : families{device.main.family, device.second.family} {
    if (families[0] == families[1]) return;
    mode = vk::SharingMode::eConcurrent;
    count = 2;
  }
  std::array<uint32_t, 2> families;
  vk::SharingMode mode = vk::SharingMode::eExclusive;
  uint32_t count = 0;
};

// What a shader wants bound: found in its SPIR-V.
struct BindingSlot {
  uint32_t binding = 0;
  vk::DescriptorType type{};
  std::string resource;  // the name of what is bound
  vk::ShaderStageFlags stages;
};

// Descriptor layout of a program, set 0 only.
struct Layout {
  std::map<std::string, BindingSlot, std::less<>> slots;
  uint32_t push_bytes = 0;
  vk::ShaderStageFlags push_stages;
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::PipelineLayout pipeline_layout = nullptr;

  // Returns the ids of its specialization constants.
  ConstantIds add_module(std::span<const uint32_t> spirv, vk::ShaderStageFlagBits stage,
                         const std::string& program);
  void create(Device::Impl& device);
};

struct ComputeProgram::Impl {
  Layout layout;
  vk::raii::Pipeline pipeline = nullptr;
};

struct RasterProgram::Impl {
  Layout layout;
  vk::raii::Pipeline pipeline = nullptr;
};

vk::Format vulkan_format(Format format);

}  // namespace ml::gpu
