// Buffers, images and their limits; copies, fills and clears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <glm/glm.hpp>

#include "harness/base/error.h"
#include "harness/gpu/commands.h"
#include "harness/gpu/memory_order.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Resources : public DeviceTest {};

TEST(MemoryOrder, FallsBackToTheNextHeapThatIsLargeEnough) {
  constexpr uint32_t local = 1, visible = 2;
  // A discrete device: 8 GB of its own, 256 MB of that which the CPU sees, and the host's memory.
  const gpu::MemoryType types[] = {{local, 0}, {local | visible, 1}, {visible, 2}};
  const uint64_t heaps[] = {uint64_t{8} << 30, uint64_t{256} << 20, uint64_t{32} << 30};
  const uint32_t upload[] = {local | visible, visible}, device[] = {local, 0};
  auto order = [&](uint32_t allowed, uint64_t bytes, std::span<const uint32_t> wishes) {
    return gpu::memory_order(types, heaps, allowed, bytes, wishes);
  };
  EXPECT_EQ(order(7, 1000, upload), (std::vector<uint32_t>{1, 2}));
  EXPECT_EQ(order(7, uint64_t{1} << 30, upload), (std::vector<uint32_t>{2})) << "more than the heap has";
  EXPECT_EQ(order(7, 1000, device), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(order(4, 1000, device), (std::vector<uint32_t>{2})) << "what the resource may lie in";
  EXPECT_EQ(order(7, uint64_t{64} << 30, device), std::vector<uint32_t>{});
}

std::vector<uint32_t> words_of(const gpu::Buffer& buffer, size_t count) {
  std::vector<uint32_t> words(count);
  std::memcpy(words.data(), buffer.mapped().data(), count * 4);
  return words;
}

TEST_F(Resources, BuffersOverTheStorageRangeAreErrors) {
  const uint64_t range = device().limits().storage_buffer_range;
  try {
    gpu::Buffer buffer(device(), range + 1, gpu::MemoryKind::device, "too large");
    ADD_FAILURE() << "no error";
  } catch (const SystemError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("too large"), text.npos) << text;
    EXPECT_NE(text.find(std::to_string(range + 1)), text.npos) << text;
    EXPECT_NE(text.find(std::to_string(range)), text.npos) << text;
  }
  gpu::UploadBuffer upload(device(), "upload");
  EXPECT_THROW(upload.map(range + 1), SystemError);
  EXPECT_EQ(upload.map(64).size(), 64u) << "the buffer can still be used";
  EXPECT_EQ(gpu::Buffer(device(), 1, gpu::MemoryKind::device, "one byte").bytes(), 1u);
}

TEST_F(Resources, ImagesOverTheLimitAreErrors) {
  const uint32_t side = device().limits().image_size;
  for (glm::uvec2 size :
       {glm::uvec2(side + 1, 1), glm::uvec2(1, side + 1), glm::uvec2(0, 1), glm::uvec2(1, 0)})
    EXPECT_THROW(gpu::Image(device(), size.x, size.y, gpu::Format::r32_uint, gpu::ImageUse::storage, "image"),
                 SystemError)
        << size.x << "x" << size.y;
  gpu::Image longest(device(), side, 1, gpu::Format::r32_uint, gpu::ImageUse::storage, "longest");
  EXPECT_EQ(longest.bytes(), size_t{side} * 4);
}

TEST_F(Resources, UploadBuffersGrowByDoublingAndNeverShrink) {
  gpu::UploadBuffer buffer(device(), "growing");
  EXPECT_EQ(buffer.capacity(), 0u);
  EXPECT_EQ(buffer.map(0).size(), 0u);
  EXPECT_GE(buffer.capacity(), 16u);
  size_t before = buffer.capacity(), growths = 0;
  for (size_t bytes = 1; bytes < 100'000; bytes += 97) {
    std::span<std::byte> memory = buffer.map(bytes);
    ASSERT_EQ(memory.size(), bytes);
    ASSERT_EQ(reinterpret_cast<uintptr_t>(memory.data()) % 64, 0u);
    std::fill(memory.begin(), memory.end(), std::byte{7});
    ASSERT_GE(buffer.capacity(), bytes);
    ASSERT_GE(buffer.capacity(), before);
    growths += buffer.capacity() != before;
    before = buffer.capacity();
  }
  EXPECT_LE(growths, 14u);
  EXPECT_LE(buffer.capacity(), 2 * 100'000u + 64);
  // Fewer bytes are the same ones.
  const std::byte* address = buffer.map(5000).data();
  std::span<std::byte> fewer = buffer.map(3);
  EXPECT_EQ(fewer.data(), address);
  EXPECT_EQ(fewer[2], std::byte{7});
  EXPECT_EQ(buffer.used(), 3u);
  EXPECT_EQ(buffer.capacity(), before);
}

TEST_F(Resources, FillsCopiesAndClearsArrive) {
  gpu::Buffer source(device(), 256, gpu::MemoryKind::device, "source"),
      back(device(), 256, gpu::MemoryKind::readback, "back");
  gpu::Image image(device(), 8, 4, gpu::Format::r32_uint, gpu::ImageUse::storage, "image");
  gpu::Commands commands(device());
  commands.begin(gpu::Timing::none);
  commands.fill(source, 0xdeadbeef);
  commands.read_buffer(source, 256, back);
  commands.submit();
  EXPECT_EQ(words_of(back, 64), std::vector<uint32_t>(64, 0xdeadbeef));

  commands.begin(gpu::Timing::none);
  commands.write_image(source, image);
  commands.read_image(image, back);
  commands.submit();
  EXPECT_EQ(words_of(back, 32), std::vector<uint32_t>(32, 0xdeadbeef));

  commands.begin(gpu::Timing::none);
  commands.clear(image);
  commands.read_image(image, back);
  commands.submit();
  EXPECT_EQ(words_of(back, 32), std::vector<uint32_t>(32, 0));
}

}  // namespace
}  // namespace ml::test
