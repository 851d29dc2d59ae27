#include <fmt/format.h>

#include <bit>

#include "harness/base/check.h"
#include "harness/gpu/debug_names.h"
#include "harness/gpu/format_features.h"
#include "harness/gpu/memory.h"

namespace ml::gpu {

Image::Image(Device& owner, const ImageDesc& desc, const std::string& name)
    : desc_(desc), impl_(std::make_unique<Impl>()) {
  Device::Impl& device = owner.impl();
  const auto [width, height, format, use, wanted_levels, sampling] = desc;
  if (width == 0 || height == 0 || width > device.limits.image_size || height > device.limits.image_size)
    throw SystemError(fmt::format("{} of {}x{} px: '{}' has images of 1 to {} px a side", name, width, height,
                                  device.info.name, device.limits.image_size));
  if (const char* what = lacking(device, format, use, sampling))
    throw SystemError(fmt::format("{}: images of format {} of '{}' lack {}", name, in_words(format),
                                  device.info.name, what));
  const auto max_levels = static_cast<uint32_t>(std::bit_width(std::max(width, height)));
  if (wanted_levels == all_levels) desc_.levels = max_levels;
  ML_CHECK_GE(desc_.levels, 1);
  ML_CHECK_LE(desc_.levels, is_depth(format) ? 1 : max_levels);
  using Usage = vk::ImageUsageFlagBits;
  vk::ImageUsageFlags usage = Usage::eTransferSrc | Usage::eTransferDst | Usage::eSampled;
  if (use == ImageUse::storage || use == ImageUse::storage_attachment) usage |= Usage::eStorage;
  if (use == ImageUse::attachment || use == ImageUse::storage_attachment)
    usage |= is_depth(format) ? Usage::eDepthStencilAttachment : Usage::eColorAttachment;
  impl_->aspect = is_depth(format) ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
  impl_->format = vulkan_format(format);
  impl_->levels = desc_.levels;
  impl_->features = features_of(device, format);
  vk::ImageCreateInfo info({}, vk::ImageType::e2D, impl_->format, vk::Extent3D(width, height, 1),
                           desc_.levels, 1, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage);
  impl_->image = vk::raii::Image(device.device, info);
  set_name(device, impl_->image, name);
  vk::MemoryRequirements needs = impl_->image.getMemoryRequirements();
  impl_->memory = allocate(device, needs, MemoryKind::device, name).memory;
  impl_->image.bindMemory(*impl_->memory, 0);
  impl_->view = impl_->view_of(device, 0, desc_.levels);
  set_name(device, impl_->view, name);
  impl_->sampler = device.samplers.get(device.device, sampling, desc_.levels);
}

vk::raii::ImageView Image::Impl::view_of(const Device::Impl& device, uint32_t first, uint32_t count) const {
  return {device.device, vk::ImageViewCreateInfo({}, *image, vk::ImageViewType::e2D, format, {},
                                                 {aspect, first, count, 0, 1})};
}

vk::ImageView Image::Impl::level_view(const Device::Impl& device, uint32_t level) {
  if (levels == 1) return *view;
  auto found = level_views.find(level);
  if (found == level_views.end()) found = level_views.emplace(level, view_of(device, level, 1)).first;
  return *found->second;
}

size_t Image::bytes() const {
  size_t sum = 0;
  for (uint32_t level = 0; level < levels(); ++level) sum += bytes(level);
  return sum;
}
size_t Image::bytes(uint32_t level) const {
  return size_t{width(level)} * height(level) * bytes_per_pixel(format());
}

Image::~Image() = default;
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;

}  // namespace ml::gpu
