// Blocks of the picture in which something is seen.
#include "harness/frame/occupied_blocks.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "scenes/scene_registry.h"
#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

class OccupiedBlocksTest : public DeviceTest {
 protected:
  static void load(DeviceFrame& frame, const Camera& camera) {
    FrameInput input;
    input.view = view_data(camera, frame.targets().width(), frame.targets().height(), 0);
    frame.load(input);
  }
  static std::set<std::pair<uint32_t, uint32_t>> blocks_of(const DeviceFrame& frame) {
    std::set<std::pair<uint32_t, uint32_t>> blocks;
    for (glm::uvec2 block : frame.occupied_blocks().positions())
      EXPECT_TRUE(blocks.emplace(block.x, block.y).second) << block.x << ", " << block.y << " twice";
    return blocks;
  }
};

TEST_F(OccupiedBlocksTest, AreThoseWithAPixelThatIsLit) {
  const Scene plane = make_scene("plane");
  for (const auto& [width, height] : {std::pair{97u, 61u}, {8u, 8u}, {1u, 1u}, {640u, 3u}, {5u, 300u}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    DeviceFrame frame(device(), plane, {}, width, height);
    // The horizon crosses the picture; then all is plane, then all is sky.
    for (float aim : {10.0f, 0.0f, 60.0f}) {
      load(frame, camera_at({0, 10, 0}, {0, aim, -1}, width, height));
      std::set<std::pair<uint32_t, uint32_t>> truth;
      const std::vector<uint8_t> lit = lit_pixels(frame);
      for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
          if (lit[size_t{y} * width + x]) truth.emplace(x / 8, y / 8);
      EXPECT_EQ(blocks_of(frame), truth);
    }
  }
  EXPECT_EQ(device().validation_messages(), std::vector<std::string>{});
}

TEST_F(OccupiedBlocksTest, OthersAreBlackWhateverWasThere) {
  constexpr uint32_t width = 64, height = 64;
  DeviceFrame frame(device(), make_scene("plane"), {}, width, height);
  const auto expect_black = [&] {
    for (float value : frame.read_floats(frame.targets().result)) ASSERT_EQ(value, 0.0f);
  };
  // Another frame's picture.
  gpu::Buffer words(device(), frame.targets().result.bytes(), gpu::MemoryKind::upload, "picture");
  std::memset(words.mapped().data(), 0x41, words.bytes());
  frame.commands().begin(gpu::Timing::none);
  frame.commands().write_image(words, frame.targets().result);
  frame.commands().submit();
  load(frame, camera_at({0, 10, 0}, {0, 60, -1}, width, height));
  EXPECT_TRUE(frame.occupied_blocks().positions().empty());
  expect_black();
  // What is read of the g-buffer goes through the same picture.
  load(frame, camera_at({0, 10, 0}, {0, 0, -1}, width, height));
  frame.read_aov(DeviceFrame::Aov::position);
  expect_black();
}

}  // namespace
}  // namespace ml::test
