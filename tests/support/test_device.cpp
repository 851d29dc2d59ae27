#include "tests/support/test_device.h"

#include <memory>

namespace ml::test {
namespace {

std::unique_ptr<gpu::Device>& holder() {
  static std::unique_ptr<gpu::Device> device;
  return device;
}

class CloseDevice final : public testing::Environment {
  void TearDown() override { holder().reset(); }
};
[[maybe_unused]] const testing::Environment* const closes_device =
    testing::AddGlobalTestEnvironment(new CloseDevice);

}  // namespace

gpu::Device& device() {
  if (!holder()) holder() = std::make_unique<gpu::Device>(gpu::DeviceOptions{"", true, true});
  return *holder();
}

void DeviceTest::SetUp() {
  messages_before_ = device().validation_messages().size();
}

void DeviceTest::TearDown() {
  std::vector<std::string> messages = device().validation_messages();
  for (size_t i = messages_before_; i < messages.size(); ++i)
    ADD_FAILURE() << "validation layer: " << messages[i];
}

}  // namespace ml::test
