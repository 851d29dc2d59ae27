// The one Vulkan device of a test program, with the validation layer listening.
#pragma once

#include <gtest/gtest.h>

#include "harness/gpu/device.h"

namespace ml::test {

// Opened when first asked for, closed after the last test.
gpu::Device& device();

// Whether it can light forward materials (fragment shaders that number triangles, and count); else why not.
constexpr const char* no_forward_materials =
    "fragment shaders of the device do not number triangles or do not count (geometryShader, "
    "fragmentStoresAndAtomics)";
inline bool lights_forward_materials() {
  return device().limits().fragment_triangles && device().limits().fragment_stores;
}

// Fails the test when the validation layer (synchronization validation included) said anything during it.
class DeviceTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

 private:
  size_t messages_before_ = 0;
};

}  // namespace ml::test
