#include "harness/gpu/vulkan.h"

namespace ml::gpu {

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

}  // namespace ml::gpu
