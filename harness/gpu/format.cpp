#include "harness/gpu/format_features.h"

namespace ml::gpu {
namespace {

struct FormatFacts {
  const char* name;
  vk::Format vulkan;
  size_t bytes;                // a pixel
  bool small_storage = false;  // as storage it needs DeviceLimits::small_storage_formats
};

FormatFacts facts(Format format) {
  using F = vk::Format;
  switch (format) {
    case Format::r8_unorm:
      return {"r8_unorm", F::eR8Unorm, 1, true};
    case Format::rg8_unorm:
      return {"rg8_unorm", F::eR8G8Unorm, 2, true};
    case Format::rgba8_unorm:
      return {"rgba8_unorm", F::eR8G8B8A8Unorm, 4};
    case Format::rgba8_srgb:
      return {"rgba8_srgb", F::eR8G8B8A8Srgb, 4};
    case Format::r16_float:
      return {"r16_float", F::eR16Sfloat, 2, true};
    case Format::rg16_float:
      return {"rg16_float", F::eR16G16Sfloat, 4, true};
    case Format::rgba16_float:
      return {"rgba16_float", F::eR16G16B16A16Sfloat, 8};
    case Format::r32_float:
      return {"r32_float", F::eR32Sfloat, 4};
    case Format::rg32_float:
      return {"rg32_float", F::eR32G32Sfloat, 8, true};
    case Format::rgba32_float:
      return {"rgba32_float", F::eR32G32B32A32Sfloat, 16};
    case Format::r32_uint:
      return {"r32_uint", F::eR32Uint, 4};
    case Format::rg32_uint:
      return {"rg32_uint", F::eR32G32Uint, 8, true};
    case Format::rgba32_uint:
      return {"rgba32_uint", F::eR32G32B32A32Uint, 16};
    case Format::d16_unorm:
      return {"d16_unorm", F::eD16Unorm, 2};
    case Format::d32_float:
      return {"d32_float", F::eD32Sfloat, 4};
  }
  throw std::logic_error("unknown format");
}

}  // namespace

vk::Format vulkan_format(Format format) {
  return facts(format).vulkan;
}
size_t bytes_per_pixel(Format format) {
  return facts(format).bytes;
}
const char* in_words(Format format) {
  return facts(format).name;
}
bool is_depth(Format format) {
  return format == Format::d16_unorm || format == Format::d32_float;
}

vk::FormatFeatureFlags2 features_of(const Device::Impl& device, Format format) {
  return device.physical
      .getFormatProperties2<vk::FormatProperties2, vk::FormatProperties3>(vulkan_format(format))
      .get<vk::FormatProperties3>()
      .optimalTilingFeatures;
}

const char* lacking(vk::FormatFeatureFlags2 features, const Sampling& sampling) {
  using Feature = vk::FormatFeatureFlagBits2;
  if ((sampling.magnify_linear || sampling.minify_linear || sampling.levels_linear) &&
      !(features & Feature::eSampledImageFilterLinear))
    return "linear filtering";
  if (sampling.compare != Sampling::Compare::none && !(features & Feature::eSampledImageDepthComparison))
    return "comparisons";
  return nullptr;
}

const char* lacking(const Device::Impl& device, Format format, ImageUse use, const Sampling& sampling) {
  using Feature = vk::FormatFeatureFlagBits2;
  const vk::FormatFeatureFlags2 features = features_of(device, format);
  if (!(features & Feature::eSampledImage)) return "sampling";
  const bool stored = use == ImageUse::storage || use == ImageUse::storage_attachment;
  const bool attached = use == ImageUse::attachment || use == ImageUse::storage_attachment;
  if (stored && (!(features & Feature::eStorageImage) ||
                 (facts(format).small_storage && !device.limits.small_storage_formats)))
    return "storage";
  const auto attachment = is_depth(format) ? Feature::eDepthStencilAttachment : Feature::eColorAttachment;
  if (attached && !(features & attachment)) return "an attachment";
  return lacking(features, sampling);
}

bool supports(const Device& device, Format format, ImageUse use, const Sampling& sampling) {
  return !lacking(device.impl(), format, use, sampling);
}

}  // namespace ml::gpu
