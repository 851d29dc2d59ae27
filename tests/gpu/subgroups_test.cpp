// Subgroups do what the shading loop counts on, however wide the device's are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "harness/base/random.h"
#include "harness/gpu/commands.h"
#include "spirv/subgroups_comp.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Subgroups : public DeviceTest {};

struct Answer {
  uint32_t size, subgroup, lane, smallest, shuffled, iterations, own_iteration, all_even, any_even;
};

std::vector<Answer> answers_of(const std::vector<uint32_t>& values) {
  gpu::ComputeProgram program(device(), subgroups_comp, "subgroups");
  const size_t bytes = values.size() * sizeof(Answer);
  gpu::UploadBuffer in(device(), "values");
  std::memcpy(in.map(values.size() * 4).data(), values.data(), values.size() * 4);
  gpu::Buffer out(device(), bytes, gpu::MemoryKind::device, "answers"),
      back(device(), bytes, gpu::MemoryKind::readback, "answers");
  gpu::Commands commands(device());
  commands.begin(gpu::Timing::none);
  commands.transfer(in);
  commands.dispatch(program, {{"Values", in}, {"Answers", out}}, std::span<const std::byte>(),
                    static_cast<uint32_t>(values.size() / 64));
  commands.read_buffer(out, bytes, back);
  commands.submit();
  std::vector<Answer> answers(values.size());
  std::memcpy(answers.data(), back.mapped().data(), bytes);
  return answers;
}

TEST_F(Subgroups, AnswerForAllTheirLanes) {
  Random random(41);
  std::vector<uint32_t> values(64 * 100);
  for (size_t i = 0; i < values.size(); ++i) values[i] = random.below(1 + static_cast<uint32_t>(i / 64)) * 2;
  for (int odd = 0; odd < 200; ++odd) values[random.below(static_cast<uint32_t>(values.size()))] += 1;
  const std::vector<Answer> answers = answers_of(values);

  // Value of each lane, by subgroup.
  std::map<uint32_t, std::map<uint32_t, uint32_t>> subgroups;
  for (size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(answers[i].size, device().limits().subgroup_size);
    ASSERT_TRUE(subgroups[answers[i].subgroup].emplace(answers[i].lane, values[i]).second) << "a lane twice";
  }
  for (size_t i = 0; i < values.size(); ++i) {
    const Answer& answer = answers[i];
    SCOPED_TRACE(testing::Message() << "invocation " << i << ", lane " << answer.lane << " of "
                                    << answer.size);
    const std::map<uint32_t, uint32_t>& lanes = subgroups[answer.subgroup];
    std::set<uint32_t> distinct;
    bool all_even = true, any_even = false;
    for (const auto& [lane, value] : lanes) {
      distinct.insert(value);
      all_even = all_even && value % 2 == 0;
      any_even = any_even || value % 2 == 0;
    }
    ASSERT_EQ(answer.smallest, *distinct.begin());
    if (const auto other = lanes.find((7 * answer.lane + 3) % answer.size); other != lanes.end()) {
      ASSERT_EQ(answer.shuffled, other->second);
    }
    ASSERT_EQ(answer.all_even, all_even);
    ASSERT_EQ(answer.any_even, any_even);
    ASSERT_EQ(answer.iterations, distinct.size());
    ASSERT_EQ(answer.own_iteration,
              static_cast<uint32_t>(std::distance(distinct.begin(), distinct.find(values[i]))));
  }
}

}  // namespace
}  // namespace ml::test
