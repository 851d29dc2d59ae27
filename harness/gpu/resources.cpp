#include "harness/gpu/resources.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/gpu/vulkan.h"

namespace ml::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// The first memory type allowed by `bits` that has all of one of the wishes, tried in order.
uint32_t memory_type(const Device::Impl& device, uint32_t bits,
                     std::initializer_list<vk::MemoryPropertyFlags> wishes) {
  for (vk::MemoryPropertyFlags wish : wishes)
    for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
      if ((bits >> i & 1) && (device.memory.memoryTypes[i].propertyFlags & wish) == wish) return i;
  throw SystemError("the device has no memory of the kind that a buffer needs");
}

uint32_t memory_type(const Device::Impl& device, uint32_t bits, MemoryKind kind) {
  vk::MemoryPropertyFlags mapped = Property::eHostVisible | Property::eHostCoherent;
  switch (kind) {
    case MemoryKind::upload:
      return memory_type(device, bits, {mapped | Property::eDeviceLocal, mapped});
    case MemoryKind::readback:
      return memory_type(device, bits, {mapped | Property::eHostCached, mapped});
    default:
      return memory_type(device, bits, {Property::eDeviceLocal, vk::MemoryPropertyFlags{}});
  }
}

vk::raii::DeviceMemory allocate(const Device::Impl& device, const vk::MemoryRequirements& needs,
                                uint32_t type, const std::string& name) {
  try {
    return {device.device, vk::MemoryAllocateInfo(needs.size, type)};
  } catch (const vk::Error& error) {
    throw SystemError(
        fmt::format("{}: the device has no {} bytes left ({})", name, needs.size, error.what()));
  }
}

}  // namespace

vk::Format vulkan_format(Format format) {
  switch (format) {
    case Format::r32_uint:
      return vk::Format::eR32Uint;
    case Format::rg32_uint:
      return vk::Format::eR32G32Uint;
    case Format::rgba32_float:
      return vk::Format::eR32G32B32A32Sfloat;
    case Format::d32_float:
      return vk::Format::eD32Sfloat;
    case Format::rgba8_srgb:
      return vk::Format::eR8G8B8A8Srgb;
  }
  throw std::logic_error("unknown format");
}

size_t bytes_per_pixel(Format format) {
  switch (format) {
    case Format::rg32_uint:
      return 8;
    case Format::rgba32_float:
      return 16;
    default:
      return 4;
  }
}

Buffer::Buffer(Device& owner, size_t bytes, MemoryKind kind, const std::string& name)
    : bytes_(bytes), impl_(std::make_unique<Impl>()) {
  const Device::Impl& device = owner.impl();
  if (kind != MemoryKind::readback && bytes > device.limits.storage_buffer_range)
    throw SystemError(fmt::format("{} needs {} bytes; one storage buffer of '{}' holds {}", name, bytes,
                                  device.info.name, device.limits.storage_buffer_range));
  using Usage = vk::BufferUsageFlagBits;
  vk::BufferUsageFlags usage = Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eTransferSrc |
                               Usage::eTransferDst | Usage::eVertexBuffer | Usage::eIndexBuffer |
                               Usage::eUniformTexelBuffer;
  // Shaders never see readback memory, so their range does not limit it.
  if (kind == MemoryKind::readback) usage = Usage::eTransferDst;
  const Sharing sharing(device);
  impl_->buffer = vk::raii::Buffer(
      device.device,
      vk::BufferCreateInfo({}, bytes, usage, sharing.mode, sharing.count, sharing.families.data()));
  vk::MemoryRequirements needs = impl_->buffer.getMemoryRequirements();
  uint32_t type = memory_type(device, needs.memoryTypeBits, kind);
  impl_->memory = allocate(device, needs, type, name);
  impl_->buffer.bindMemory(*impl_->memory, 0);
  if (kind != MemoryKind::readback && bytes >= quad_bytes)
    impl_->quads = vk::raii::BufferView(
        device.device, vk::BufferViewCreateInfo({}, *impl_->buffer, vk::Format::eR32G32B32A32Uint, 0,
                                                std::min<uint64_t>(bytes, device.limits.texel_buffer_bytes) /
                                                    quad_bytes * quad_bytes));
  impl_->device_local =
      static_cast<bool>(device.memory.memoryTypes[type].propertyFlags & Property::eDeviceLocal);
  impl_->cached = static_cast<bool>(device.memory.memoryTypes[type].propertyFlags & Property::eHostCached);
  if (kind != MemoryKind::device)
    impl_->mapped = {static_cast<std::byte*>(impl_->memory.mapMemory(0, VK_WHOLE_SIZE)), bytes};
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
std::span<std::byte> Buffer::mapped() const {
  return impl_->mapped;
}
bool Buffer::device_local() const {
  return impl_->device_local;
}
bool Buffer::cached() const {
  return impl_->cached;
}

std::span<std::byte> UploadBuffer::map(size_t bytes) {
  if (!host_ || bytes > host_->bytes()) {
    size_t limit = device_->limits().storage_buffer_range;
    size_t wanted = std::max<size_t>(bytes, 16);
    // Doubling keeps growth rare; near the limit the exact size may still fit.
    if (host_) wanted = std::max(wanted, std::min(2 * host_->bytes(), limit));
    host_ =
        std::make_unique<Buffer>(*device_, (wanted + 63) / 64 * 64 > limit ? wanted : (wanted + 63) / 64 * 64,
                                 MemoryKind::upload, name_);
    twin_.reset();
    if (!host_->device_local())
      twin_ = std::make_unique<Buffer>(*device_, host_->bytes(), MemoryKind::device, name_);
  }
  used_ = bytes;
  return host_->mapped().first(bytes);
}

Image::Image(Device& owner, uint32_t width, uint32_t height, Format format, ImageUse use,
             const std::string& name)
    : width_(width), height_(height), format_(format), impl_(std::make_unique<Impl>()) {
  const Device::Impl& device = owner.impl();
  if (width == 0 || height == 0 || width > device.limits.image_size || height > device.limits.image_size)
    throw SystemError(fmt::format("{} of {}x{} px: '{}' has images of 1 to {} px a side", name, width, height,
                                  device.info.name, device.limits.image_size));
  bool depth = format == Format::d32_float;
  impl_->aspect = depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
  using Usage = vk::ImageUsageFlagBits;
  vk::ImageUsageFlags usage = Usage::eTransferSrc | Usage::eTransferDst | Usage::eSampled;
  if (use == ImageUse::storage || use == ImageUse::storage_attachment) usage |= Usage::eStorage;
  if (use == ImageUse::attachment || use == ImageUse::storage_attachment)
    usage |= depth ? Usage::eDepthStencilAttachment : Usage::eColorAttachment;
  vk::ImageCreateInfo info({}, vk::ImageType::e2D, vulkan_format(format), vk::Extent3D(width, height, 1), 1,
                           1, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage);
  impl_->image = vk::raii::Image(device.device, info);
  vk::MemoryRequirements needs = impl_->image.getMemoryRequirements();
  impl_->memory =
      allocate(device, needs, memory_type(device, needs.memoryTypeBits, MemoryKind::device), name);
  impl_->image.bindMemory(*impl_->memory, 0);
  impl_->view = vk::raii::ImageView(
      device.device, vk::ImageViewCreateInfo({}, *impl_->image, vk::ImageViewType::e2D, vulkan_format(format),
                                             {}, {impl_->aspect, 0, 1, 0, 1}));
  bool filter = use == ImageUse::texture;
  vk::SamplerCreateInfo sampler({}, filter ? vk::Filter::eLinear : vk::Filter::eNearest,
                                filter ? vk::Filter::eLinear : vk::Filter::eNearest,
                                vk::SamplerMipmapMode::eNearest, vk::SamplerAddressMode::eRepeat,
                                vk::SamplerAddressMode::eRepeat, vk::SamplerAddressMode::eRepeat);
  impl_->sampler = vk::raii::Sampler(device.device, sampler);
}

Image::~Image() = default;
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;

}  // namespace ml::gpu
