// Which options are on, on devices that need not be there.
#include "harness/frame/frame_options.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "harness/base/error.h"

namespace ml {
namespace {

gpu::DeviceInfo device_of(const char* type) {
  gpu::DeviceInfo info;
  info.type = type;
  return info;
}

gpu::DeviceLimits limits_of(uint64_t texel_bytes) {
  gpu::DeviceLimits limits;
  limits.storage_buffer_range = 1 << 27;
  limits.texel_buffer_bytes = texel_bytes;
  return limits;
}

TEST(TexelFetch, IsForSoftwareDevicesThatShowEverythingSo) {
  const FrameOptions options;
  EXPECT_TRUE(options.fetches_texels(device_of("cpu"), limits_of(1 << 27)));
  EXPECT_FALSE(options.fetches_texels(device_of("cpu"), limits_of((1 << 27) - 16)));
  EXPECT_FALSE(options.fetches_texels(device_of("cpu"), limits_of(1 << 20)));
  for (const char* type : {"discrete", "integrated", "virtual", "other"})
    EXPECT_FALSE(options.fetches_texels(device_of(type), limits_of(uint64_t{1} << 31))) << type;
}

TEST(TexelFetch, IsAsAskedOnAnyDevice) {
  for (const char* type : {"cpu", "discrete"})
    for (uint64_t bytes : {uint64_t{1} << 20, uint64_t{1} << 31}) {
      EXPECT_TRUE(
          FrameOptions{.shading = {.texel_fetch = true}}.fetches_texels(device_of(type), limits_of(bytes)));
      EXPECT_FALSE(
          FrameOptions{.shading = {.texel_fetch = false}}.fetches_texels(device_of(type), limits_of(bytes)));
    }
}

// The smallest limit that Vulkan allows is 65,536 texels: 32,768 lights.
TEST(TexelFetch, WhatATexelBufferCannotShowIsOneClearLine) {
  const gpu::DeviceLimits limits = limits_of(1 << 20);
  EXPECT_NO_THROW(require_texels(limits, "32768 lights", 32768 * 32));
  try {
    require_texels(limits, "32769 lights", 32769 * 32);
    ADD_FAILURE() << "no error";
  } catch (const SystemError& error) {
    const std::string text = error.what();
    for (const char* part : {"32769 lights", "1048608 bytes", "1048576", "shading.light_fetch=storage"})
      EXPECT_NE(text.find(part), text.npos) << text;
    EXPECT_EQ(text.find('\n'), text.npos) << text;
  }
}

}  // namespace
}  // namespace ml
