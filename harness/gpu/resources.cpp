#include "harness/gpu/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/gpu/memory_order.h"
#include "harness/gpu/vulkan.h"

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

struct Allocation {
  vk::raii::DeviceMemory memory;
  uint32_t type;
};

// Out of the first heap that has room: those of the best kind come first.
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

vk::SamplerAddressMode address_mode(Sampling::Edge edge) {
  switch (edge) {
    case Sampling::Edge::mirrored_repeat:
      return vk::SamplerAddressMode::eMirroredRepeat;
    case Sampling::Edge::clamp:
      return vk::SamplerAddressMode::eClampToEdge;
    default:
      return vk::SamplerAddressMode::eRepeat;
  }
}

vk::SamplerCreateInfo sampler_info(const Sampling& sampling) {
  auto filter = [](bool linear) { return linear ? vk::Filter::eLinear : vk::Filter::eNearest; };
  vk::SamplerCreateInfo info(
      {}, filter(sampling.magnify_linear), filter(sampling.minify_linear),
      sampling.levels_linear ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
      address_mode(sampling.u), address_mode(sampling.v));
  // With one level the level of detail still chooses between the two filters, which it cannot when it is held
  // at 0 (Vulkan 1.3, VkSamplerCreateInfo: how OpenGL's filters without levels are said).
  if (sampling.levels > 1)
    info.maxLod = static_cast<float>(sampling.levels);
  else if (sampling.magnify_linear != sampling.minify_linear)
    info.maxLod = 0.25f;
  return info;
}

// Whole words, from the first one that begins in it.
void poison(std::span<std::byte> memory) {
  const size_t skipped = std::min<size_t>(-reinterpret_cast<uintptr_t>(memory.data()) % 4, memory.size());
  std::fill_n(reinterpret_cast<uint32_t*>(memory.data() + skipped), (memory.size() - skipped) / 4,
              poison_word);
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
    case Format::rgba8_unorm:
      return vk::Format::eR8G8B8A8Unorm;
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
  Allocation found = allocate(device, needs, kind, name);
  const vk::MemoryPropertyFlags properties = device.memory.memoryTypes[found.type].propertyFlags;
  impl_->memory = std::move(found.memory);
  impl_->buffer.bindMemory(*impl_->memory, 0);
  if (kind != MemoryKind::readback && bytes >= quad_bytes)
    impl_->quads = vk::raii::BufferView(
        device.device, vk::BufferViewCreateInfo({}, *impl_->buffer, vk::Format::eR32G32B32A32Uint, 0,
                                                std::min<uint64_t>(bytes, device.limits.texel_buffer_bytes) /
                                                    quad_bytes * quad_bytes));
  impl_->device_local = static_cast<bool>(properties & Property::eDeviceLocal);
  impl_->cached = static_cast<bool>(properties & Property::eHostCached);
  if (kind != MemoryKind::device)
    impl_->mapped = {static_cast<std::byte*>(impl_->memory.mapMemory(0, VK_WHOLE_SIZE)), bytes};
  if (!device.poison) return;
  poison(impl_->mapped);
  if (kind != MemoryKind::device) return;
  Commands commands(owner);
  commands.begin(Timing::none);
  commands.fill(*this, poison_word);
  commands.submit();
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
  if (device_->impl().poison) poison(host_->mapped().subspan(bytes));
  return host_->mapped().first(bytes);
}

Image::Image(Device& owner, uint32_t width, uint32_t height, Format format, ImageUse use,
             const std::string& name, const Sampling& sampling)
    : width_(width),
      height_(height),
      levels_(use == ImageUse::texture ? sampling.levels : 1),
      format_(format),
      impl_(std::make_unique<Impl>()) {
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
  vk::ImageCreateInfo info({}, vk::ImageType::e2D, vulkan_format(format), vk::Extent3D(width, height, 1),
                           levels_, 1, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage);
  impl_->image = vk::raii::Image(device.device, info);
  vk::MemoryRequirements needs = impl_->image.getMemoryRequirements();
  impl_->memory = allocate(device, needs, MemoryKind::device, name).memory;
  impl_->image.bindMemory(*impl_->memory, 0);
  impl_->view = vk::raii::ImageView(
      device.device, vk::ImageViewCreateInfo({}, *impl_->image, vk::ImageViewType::e2D, vulkan_format(format),
                                             {}, {impl_->aspect, 0, levels_, 0, 1}));
  const Sampling pixel_by_pixel{.magnify_linear = false, .minify_linear = false};
  impl_->sampler =
      vk::raii::Sampler(device.device, sampler_info(use == ImageUse::texture ? sampling : pixel_by_pixel));
}

size_t Image::bytes() const {
  size_t sum = 0;
  for (uint32_t level = 0; level < levels_; ++level) sum += size_t{width(level)} * height(level);
  return sum * bytes_per_pixel(format_);
}

Image::~Image() = default;
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;

}  // namespace ml::gpu
