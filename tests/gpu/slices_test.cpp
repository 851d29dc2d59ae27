// The slice of a depth is the same on the device and on the CPU, bit for bit.
#include "shaders/shared/slices.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "harness/base/random.h"
#include "harness/gpu/commands.h"
#include "spirv/slices_comp.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

using gpu_data::SliceMapping;

class Slices : public DeviceTest {};

SliceMapping mapping_of(float zmin, float zmax, uint32_t slices) {
  const float low = gpu_data::slice_log2(zmin);
  return {low, static_cast<float>(slices - 1) / (gpu_data::slice_log2(zmax) - low), slices};
}

// Every exponent, the neighbours of every boundary, ordinary depths, and what is no depth at all.
std::vector<float> depths_for(const SliceMapping& mapping) {
  std::vector<float> depths;
  for (float special : {0.0f, -0.0f, -1.0f, -1e30f, 1e-45f, 1e-38f, 1e-30f, std::nextafter(1e-30f, 1.0f),
                        std::numeric_limits<float>::max(), std::numeric_limits<float>::infinity(),
                        -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
                        -std::numeric_limits<float>::quiet_NaN()})
    depths.push_back(special);
  for (uint32_t exponent = 0; exponent < 256; ++exponent)
    for (uint32_t mantissa : {0u, 1u, 0x3504f2u, 0x3504f3u, 0x3504f4u, 0x400000u, 0x7ffffeu, 0x7fffffu})
      depths.push_back(std::bit_cast<float>(exponent << 23 | mantissa));
  for (uint32_t slice = 0; slice < mapping.count; ++slice) {
    auto boundary =
        static_cast<float>(std::exp2(static_cast<double>(mapping.log_min) +
                                     (slice - 1.0) / std::max(static_cast<double>(mapping.scale), 1e-9)));
    for (int step = -8; step <= 8; ++step)
      depths.push_back(std::bit_cast<float>(
          static_cast<uint32_t>(static_cast<int>(std::bit_cast<uint32_t>(boundary)) + step)));
  }
  Random random(5);
  while (depths.size() < 200'000) depths.push_back(std::exp2(random.uniform(-8, 14)));
  while (depths.size() < 350'000) depths.push_back(std::bit_cast<float>(random.next()));
  return depths;
}

std::vector<uint32_t> slices_on_device(const gpu::ComputeProgram& program, const std::vector<float>& depths,
                                       const SliceMapping& mapping) {
  struct Push {
    SliceMapping mapping;
    uint32_t count;
  };
  const size_t bytes = depths.size() * 4;
  gpu::UploadBuffer in(device(), "depths");
  std::memcpy(in.map(bytes).data(), depths.data(), bytes);
  gpu::Buffer out(device(), bytes, gpu::MemoryKind::device, "slices"),
      back(device(), bytes, gpu::MemoryKind::readback, "slices");
  gpu::Commands commands(device());
  commands.begin(gpu::Timing::none);
  commands.transfer(in);
  commands.dispatch(program, {{"Depths", in}, {"Slices", out}},
                    Push{mapping, static_cast<uint32_t>(depths.size())},
                    static_cast<uint32_t>((depths.size() + 63) / 64));
  commands.read_buffer(out, bytes, back);
  commands.submit();
  std::vector<uint32_t> slices(depths.size());
  std::memcpy(slices.data(), back.mapped().data(), bytes);
  return slices;
}

TEST_F(Slices, AreTheSameOnDeviceAndCpu) {
  gpu::ComputeProgram program(device(), slices_comp, "slices");
  for (const SliceMapping& mapping :
       {mapping_of(5, 500, 16), mapping_of(0.01f, 1e9f, 256), mapping_of(0.1f, 0.1001f, 64),
        mapping_of(5, 500, 1), mapping_of(1, 2, 2)}) {
    SCOPED_TRACE(testing::Message() << mapping.count << " slices, scale " << mapping.scale);
    const std::vector<float> depths = depths_for(mapping);
    const std::vector<uint32_t> slices = slices_on_device(program, depths, mapping);
    for (size_t i = 0; i < depths.size(); ++i) {
      ASSERT_EQ(slices[i], gpu_data::slice_of_depth(depths[i], mapping)) << "depth " << depths[i];
      ASSERT_LT(slices[i], mapping.count) << "depth " << depths[i];
    }
  }
}

TEST_F(Slices, AreThoseOfThePaper) {
  gpu::ComputeProgram program(device(), slices_comp, "slices");
  const SliceMapping mapping = mapping_of(5, 500, 16);
  const float none = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  // One near slice up to 5 m, fifteen exponential ones to 500 m; 50 m is half-way in the logarithm.
  const std::vector<float> depths{4.9f, 5, 50, 499, 500, 1e9f, infinite, 0, -1, -infinite, none, 1e-40f};
  const std::vector<uint32_t> expected{0, 1, 8, 15, 15, 15, 15, 0, 0, 0, 0, 0};
  EXPECT_EQ(slices_on_device(program, depths, mapping), expected);
}

}  // namespace
}  // namespace ml::test
