// Names of objects, which debuggers and the validation layer show.
#include <gtest/gtest.h>

#include "harness/gpu/commands.h"

namespace ml::test {
namespace {

TEST(ObjectNames, StandInMessages) {
  gpu::Device own({"", true});
  const gpu::Buffer back(own, 64, gpu::MemoryKind::readback, "back of the house"),
      into(own, 64, gpu::MemoryKind::device, "front of the house");
  ASSERT_TRUE(own.validation_messages().empty()) << own.validation_messages().front();
  {
    gpu::Commands commands(own);
    commands.begin(gpu::Timing::none);
    auto span = commands.span("a span");
    // Nothing may be copied out of readback memory: the layer says so. It is never submitted.
    commands.read_buffer(back, 64, into);
  }
  const std::vector<std::string> messages = own.validation_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("back of the house"), std::string::npos) << messages[0];
}

TEST(ObjectNames, AreNotNeeded) {
  gpu::Device own({"", false});
  const gpu::Buffer buffer(own, 64, gpu::MemoryKind::device, "buffer");
  gpu::Commands commands(own);
  commands.begin(gpu::Timing::none);
  {
    auto span = commands.span("span");
    commands.fill(buffer, 1);
  }
  commands.submit();
}

}  // namespace
}  // namespace ml::test
