// Dispatches whose number of workgroups is the device's.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/glm.hpp>

#include "harness/gpu/commands.h"
#include "spirv/count_groups_comp.h"
#include "spirv/group_counts_comp.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Indirect : public DeviceTest {
 protected:
  struct Counts {
    glm::uvec3 counts;
    uint32_t first_word;
  };
  struct Counted {
    uint32_t count;
    glm::uvec3 last;
    bool operator==(const Counted&) const = default;
  };

  // As many as a pass before says, at the given byte.
  Counted run(const glm::uvec3& counts, size_t offset) {
    gpu::Buffer back(device(), sizeof(Counted), gpu::MemoryKind::readback, "back");
    commands_.begin(gpu::Timing::none);
    commands_.fill(groups_, 1);
    commands_.fill(count_, 0);
    commands_.dispatch(write_, {{"Groups", groups_}}, Counts{counts, static_cast<uint32_t>(offset / 4)}, 1);
    commands_.dispatch_indirect(read_, {{"Count", count_}}, std::span<const std::byte>(), groups_, offset);
    commands_.read_buffer(count_, sizeof(Counted), back);
    commands_.submit();
    Counted counted;
    std::memcpy(&counted, back.mapped().data(), sizeof(counted));
    return counted;
  }

  gpu::ComputeProgram write_{device(), group_counts_comp, "group counts"},
      read_{device(), count_groups_comp, "count groups"};
  gpu::Buffer groups_{device(), 40, gpu::MemoryKind::device, "groups"},
      count_{device(), sizeof(Counted), gpu::MemoryKind::device, "count"};
  gpu::Commands commands_{device()};
};

TEST_F(Indirect, APassSaysHowManyTheNextOneHas) {
  EXPECT_EQ(run({5, 3, 2}, 0), (Counted{30, {4, 2, 1}}));
  EXPECT_EQ(run({1, 1, 1}, 4), (Counted{1, {0, 0, 0}}));
  EXPECT_EQ(run({700, 1, 2}, 28), (Counted{1400, {699, 0, 1}})) << "the last words of the buffer";
  EXPECT_EQ(run({4, 0, 2}, 12), (Counted{0, {0, 0, 0}}));
}

TEST_F(Indirect, CountsLieInTheBuffer) {
  const gpu::Buffer tiny(device(), 8, gpu::MemoryKind::device, "tiny"),
      back(device(), 64, gpu::MemoryKind::readback, "back");
  auto dispatch = [&](const gpu::Buffer& groups, size_t offset) {
    commands_.dispatch_indirect(read_, {{"Count", count_}}, std::span<const std::byte>(), groups, offset);
  };
  commands_.begin(gpu::Timing::none);
  EXPECT_THROW(dispatch(groups_, 2), std::logic_error);
  EXPECT_THROW(dispatch(groups_, 32), std::logic_error);
  EXPECT_THROW(dispatch(groups_, size_t(0) - 4), std::logic_error);
  EXPECT_THROW(dispatch(tiny, 0), std::logic_error);
  EXPECT_THROW(dispatch(back, 0), std::logic_error) << "readback memory";
  commands_.submit();
}

}  // namespace
}  // namespace ml::test
