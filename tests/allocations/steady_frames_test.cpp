// A lap of frames that was prepared before takes nothing from the heap: the first lap leaves all buffers as
// large as the path needs them, and every algorithm keeps its own.
//
// With more threads than one the same holds for the project's code. oneTBB takes what it needs for tasks and
// workers from a pool of its own, and a little from the heap when it starts a thread: that is counted apart
// and not limited.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/heap_memory.h"
#include "harness/frame/frame_input.h"
#include "heap_watch.h"
#include "scenes/load_scene.h"

namespace ml {
namespace {

using test::HeapUse;
using test::HeapWatch;

constexpr uint32_t width = 320, height = 180, frames = 5;

const Scene& canyon() {
  static const Scene scene = [] {
    SceneSpec spec;
    spec.procedural = "canyon";
    return load_scene(spec);
  }();
  return scene;
}

// Lights of all shapes, enough of them that two threads both have some; they move as `script` says.
LightSet moving_lights(LightScript script) {
  LightSpec spec;
  spec.count = 6000;
  spec.spot_fraction = spec.capsule_fraction = spec.wedge_fraction = spec.box_fraction = 0.1f;
  spec.script = script;
  return LightSet(spec, canyon());
}

std::vector<ParameterValue> values_of(const ParameterInfo& info) {
  if (!info.choices.empty()) return {info.choices.begin(), info.choices.end()};
  if (std::holds_alternative<bool>(info.fallback)) return {false, true};
  if (std::holds_alternative<int64_t>(info.fallback))
    return {static_cast<int64_t>(info.minimum), static_cast<int64_t>(info.maximum)};
  return {info.minimum, info.maximum};
}

bool is_switch(const ParameterInfo& info) {
  return !info.choices.empty() || std::holds_alternative<bool>(info.fallback);
}

// All combinations of what can be switched, with the other parameters at their defaults; and each number at
// both ends of its range with the switches at theirs.
std::vector<Parameters> settings_of(const AlgorithmEntry& entry) {
  const std::vector<ParameterInfo>& infos = entry.parameters;
  std::vector<Parameters> settings{Parameters(infos)};
  for (const ParameterInfo& info : infos) {
    if (!is_switch(info)) continue;
    std::vector<Parameters> more;
    for (const Parameters& base : settings)
      for (const ParameterValue& value : values_of(info))
        more.push_back(base), more.back().set(infos, info.name, value, "test");
    settings = std::move(more);
  }
  for (const ParameterInfo& info : infos) {
    if (is_switch(info)) continue;
    for (const ParameterValue& value : values_of(info))
      settings.emplace_back(infos), settings.back().set(infos, info.name, value, "test");
  }
  if (entry.check)
    std::erase_if(settings, [&](const Parameters& p) { return !entry.check(p, width, height).empty(); });
  return settings;
}

std::string text_of(const Parameters& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters.values())
    std::visit([&, &key = name](const auto& v) { text += fmt::format(" {}={}", key, v); }, value);
  return text;
}

class Lap {
 public:
  Lap(const LightSet& lights, unsigned threads)
      : threads_(threads),
        sequence_(canyon(), lights, canyon().path("default"), frames, width, height, threads_) {}

  // Prepares every frame once, and watches the heap while it does.
  HeapUse run(Algorithm& algorithm) {
    HeapUse sum;
    for (uint32_t frame = 0; frame < frames; ++frame) {
      const FrameInput& input = sequence_.at(frame);
      spans_.clear();
      HeapWatch watch;
      algorithm.prepare(input, memory_, spans_);
      const HeapUse use = watch.stop();
      if (sum.own == 0) sum.first = use.first;
      sum.own += use.own;
      sum.workers += use.workers;
    }
    return sum;
  }

 private:
  Threads threads_;
  FrameSequence sequence_;
  HeapMemory memory_;
  Spans spans_;
};

struct Case {
  std::string algorithm;
  LightScript script;
  unsigned threads;
};

class SteadyFrames : public testing::TestWithParam<Case> {};

TEST_P(SteadyFrames, TakeNothingFromTheHeap) {
  const Case& given = GetParam();
  const AlgorithmEntry& entry = find_algorithm(given.algorithm, "test");
  const LightSet lights = moving_lights(given.script);
  for (const Parameters& parameters : settings_of(entry)) {
    SCOPED_TRACE(text_of(parameters));
    std::unique_ptr<Algorithm> algorithm = entry.create(parameters);
    Lap lap(lights, given.threads);
    lap.run(*algorithm);
    const HeapUse steady = lap.run(*algorithm);
    EXPECT_EQ(steady.own, 0u) << "the first at " << steady.first;
    if (given.threads == 1) {
      EXPECT_EQ(steady.workers, 0u);
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const AlgorithmEntry& entry : algorithm_registry())
    for (LightScript script : {LightScript::drift, LightScript::spawn})
      for (unsigned threads : {1u, 2u}) list.push_back({entry.info.name, script, threads});
  return list;
}

std::ostream& operator<<(std::ostream& out, const Case& given) {
  return out << given.algorithm;
}

std::string name_of(const testing::TestParamInfo<Case>& given) {
  return fmt::format("{}_{}_{}", given.param.algorithm,
                     given.param.script == LightScript::drift ? "drift" : "spawn",
                     given.param.threads == 1 ? "one_thread" : "two_threads");
}

INSTANTIATE_TEST_SUITE_P(Every, SteadyFrames, testing::ValuesIn(cases()), name_of);

// The optimizer may leave out memory that nobody sees.
void* volatile seen;

TEST(HeapWatch, SeesEveryWayToTakeMemory) {
  const auto uses = [](auto&& body) {
    HeapWatch watch;
    body();
    return watch.stop().own;
  };
  EXPECT_EQ(uses([] {}), 0u);
  EXPECT_EQ(uses([] {
              std::vector<uint32_t> local(8);
              seen = local.data();
            }),
            1u);
  EXPECT_EQ(uses([] {
              seen = std::malloc(8);
              std::free(seen);
            }),
            1u);
  EXPECT_EQ(uses([] {
              seen = std::calloc(8, 1);
              std::free(seen);
            }),
            1u);
  EXPECT_EQ(uses([] {
              seen = std::aligned_alloc(64, 64);
              std::free(seen);
            }),
            1u);
  EXPECT_EQ(uses([] {
              seen = std::realloc(nullptr, 8);
              std::free(seen);
            }),
            1u);
  struct alignas(128) Wide {
    char bytes[128];
  };
  EXPECT_EQ(uses([] {
              auto wide = std::make_unique<Wide>();
              seen = wide.get();
            }),
            1u);
}

TEST(HeapWatch, KeepsWhatThreadsTakeApart) {
  Threads threads(2);
  HeapWatch watch;
  threads.for_each(1000, [](size_t) {});
  const HeapUse empty = watch.stop();
  EXPECT_EQ(empty.own, 0u) << empty.first;
  HeapWatch again;
  threads.for_each(1000, [](size_t i) {
    std::vector<size_t> local(8, i);
    seen = local.data();
  });
  EXPECT_GE(again.stop().own, 1000u);
}

TEST(SteadyInput, TakesNothingFromTheHeap) {
  for (LightScript script : {LightScript::none, LightScript::drift, LightScript::spawn, LightScript::orbit}) {
    const LightSet lights = moving_lights(script);
    Threads threads(1);
    FrameSequence sequence(canyon(), lights, canyon().path("default"), frames, width, height, threads);
    for (uint32_t frame = 0; frame < frames; ++frame) sequence.at(frame);
    HeapWatch watch;
    for (uint32_t frame = 0; frame < frames; ++frame) sequence.at(frame);
    const HeapUse use = watch.stop();
    EXPECT_EQ(use.own, 0u) << "script " << static_cast<int>(script) << ", the first at " << use.first;
  }
}

}  // namespace
}  // namespace ml
