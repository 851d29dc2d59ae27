#include <fmt/format.h>

#include <algorithm>

#include "harness/gpu/debug_names.h"
#include "harness/gpu/memory.h"

namespace ml::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// Whole words, from the first one that begins in it.
void poison(std::span<std::byte> memory) {
  const size_t skipped = std::min<size_t>(-reinterpret_cast<uintptr_t>(memory.data()) % 4, memory.size());
  std::fill_n(reinterpret_cast<uint32_t*>(memory.data() + skipped), (memory.size() - skipped) / 4,
              poison_word);
}

}  // namespace

Buffer::Buffer(Device& owner, size_t bytes, MemoryKind kind, const std::string& name)
    : bytes_(bytes), impl_(std::make_unique<Impl>()) {
  const Device::Impl& device = owner.impl();
  if (kind != MemoryKind::readback && bytes > device.limits.storage_buffer_range)
    throw SystemError(fmt::format("{} needs {} bytes; one storage buffer of '{}' holds {}", name, bytes,
                                  device.info.name, device.limits.storage_buffer_range));
  using Usage = vk::BufferUsageFlagBits;
  vk::BufferUsageFlags usage = Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eTransferSrc |
                               Usage::eTransferDst | Usage::eVertexBuffer | Usage::eIndexBuffer |
                               Usage::eUniformTexelBuffer | Usage::eIndirectBuffer;
  // Shaders never see readback memory, so their range does not limit it.
  if (kind == MemoryKind::readback) usage = Usage::eTransferDst;
  const Sharing sharing(device);
  impl_->buffer = vk::raii::Buffer(
      device.device,
      vk::BufferCreateInfo({}, bytes, usage, sharing.mode, sharing.count, sharing.families.data()));
  impl_->kind = kind;
  set_name(device, impl_->buffer, name);
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
    device_copy_.reset();
    if (!host_->device_local())
      device_copy_ = std::make_unique<Buffer>(*device_, host_->bytes(), MemoryKind::device, name_);
  }
  used_ = bytes;
  if (device_->impl().poison) poison(host_->mapped().subspan(bytes));
  return host_->mapped().first(bytes);
}

}  // namespace ml::gpu
