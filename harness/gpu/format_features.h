// Private to this room: what a device does with a format.
#pragma once

#include "harness/gpu/vulkan.h"

namespace ml::gpu {

vk::FormatFeatureFlags2 features_of(const Device::Impl& device, Format format);

// What is asked for and not there, in words ("storage", "comparisons"); nullptr where all is.
const char* lacking(vk::FormatFeatureFlags2 features, const Sampling& sampling);
const char* lacking(const Device::Impl& device, Format format, ImageUse use, const Sampling& sampling);

}  // namespace ml::gpu
