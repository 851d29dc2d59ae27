#include <fmt/format.h>

#include "harness/gpu/memory.h"

namespace ml::gpu {
namespace {

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

}  // namespace

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
