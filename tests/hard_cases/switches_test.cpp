// Every combination of an algorithm's switches (booleans and choices), on frames in which lists and trees,
// sky and surface, few and many lights meet in one subgroup. Memory that nothing has written is garbage, that
// which a workgroup shares too, so that luck does not hide what is read before it is written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/hard_cases/hard_cases.h"
#include "tests/support/drivers.h"

namespace ml::test {
namespace {

// No multiple of a tile: the last ones are cut, and tiles of 12 px end within subgroups.
constexpr uint32_t width = 61, height = 45;

// Few lights everywhere, and a crowd of small ones at several depths: some froxels have a tree, others a list
// of a light or two, some nothing. Few lights in all, so that the first tree begins at node 0.
std::vector<Light> few_and_many() {
  std::vector<Light> lights = mixed_shapes(40, {-25, 0, -30}, {25, 9, 18}, 1, 15, 5);
  const std::vector<Light> crowd = scattered(260, {-6, 0, -14}, {3, 4, 6}, 0.2f, 1.5f, 6, 4);
  lights.insert(lights.end(), crowd.begin(), crowd.end());
  return lights;
}

// The algorithm's parameters with every value of every switch; parameters that are numbers have a few values
// in turn.
std::vector<Trial> combinations(const AlgorithmEntry& entry) {
  std::vector<Trial> trials{{entry.info.name, Parameters(entry.parameters)}};
  for (const ParameterInfo& info : entry.parameters) {
    if (info.name == "caps") continue;  // the chapter's lose lights by design
    std::vector<ParameterValue> values;
    for (const std::string& choice : info.choices) values.emplace_back(choice);
    if (std::holds_alternative<bool>(info.fallback)) values = {false, true};
    if (values.empty()) continue;
    std::vector<Trial> more;
    for (const Trial& trial : trials)
      for (const ParameterValue& value : values) {
        more.push_back(trial);
        more.back().parameters.set(entry.parameters, info.name, value, "test");
      }
    trials = std::move(more);
  }
  const auto set = [&](Trial& trial, const char* name, const ParameterValue& value) {
    if (trial.parameters.values().contains(name)) trial.parameters.set(entry.parameters, name, value, "test");
  };
  for (size_t i = 0; i < trials.size(); ++i) {
    set(trials[i], "tile", int64_t{i % 3 == 0 ? 12 : i % 3 == 1 ? 16 : 7});
    set(trials[i], "slices", int64_t{i % 2 == 0 ? 16 : 5});
    set(trials[i], "lights_per_leaf", int64_t{i % 5 == 0 ? 2 : 8});
  }
  std::erase_if(trials, [&](const Trial& trial) {
    return entry.check && !entry.check(trial.parameters, width, height).empty();
  });
  return trials;
}

// Of what the programs are made for besides; the combinations take turns with these.
std::vector<FrameOptions> surroundings() {
  std::vector<FrameOptions> list;
  for (uint32_t i = 0; i < 4; ++i) {
    FrameOptions options = all_shapes(i == 3);
    options.shading.texel_fetch = i % 2 == 1;
    options.tests.any_subgroup_size = i == 2;
    options.shading.test_ahead = i == 1;
    options.tests.poison_shared = true;
    list.push_back(options);
  }
  return list;
}

class Switches : public DeviceTest, public testing::WithParamInterface<std::string> {};

TEST_P(Switches, EveryCombinationLosesNothing) {
  const std::vector<Trial> trials = combinations(find_algorithm(GetParam(), "test"));
  const std::vector<Light> lights = few_and_many();
  const Camera camera = camera_at({-3, 3, 20}, {-2, 3.5, 0}, width, height);
  const std::vector<FrameOptions> options = surroundings();
  for (size_t e = 0; e < options.size(); ++e) {
    SCOPED_TRACE(fmt::format("surroundings {}", e));
    // One in four with each, so that every pair of a switch and a surrounding is met where there are many. Of
    // these one in eight where a driver takes minutes to compile them all.
    const size_t thinned = on_swiftshader() ? 8 : 1;
    std::vector<Trial> chosen;
    for (size_t i = 0; i < trials.size(); ++i)
      if (trials.size() < 4 * options.size() ||
          ((i + i / options.size()) % options.size() == e && i / options.size() % thinned == 0))
        chosen.push_back(trials[i]);
    Exactness check(yard(), width, height, options[e]);
    const Seen seen = check.expect_trials(camera, lights, chosen, 0);
    EXPECT_GT(seen.lit_pixels(), 0u);
    EXPECT_LT(seen.lit_pixels(), uint64_t{width} * height) << "there is no sky";
  }
}

std::vector<std::string> exact_algorithms() {
  std::vector<std::string> names;
  for (const Trial& trial : every_algorithm()) names.push_back(trial.algorithm);
  return names;
}

INSTANTIATE_TEST_SUITE_P(HardCases, Switches, testing::ValuesIn(exact_algorithms()),
                         [](const auto& instance) { return instance.param; });

// A list's pixels have node 0 and end 0, and the first tree begins at node 0: pixels of both in one subgroup.
TEST_F(HardCases, Hybrid_ListsAndTheFirstTreeInOneSubgroup) {
  const AlgorithmEntry& entry = find_algorithm("hybrid", "test");
  Trial trial{"hybrid", Parameters(entry.parameters)};
  trial.parameters.set(entry.parameters, "walk", std::string("pixel"), "test");
  trial.parameters.set(entry.parameters, "shared_tree", true, "test");
  FrameOptions options{.effects = {.spots = true}, .many_lights = false};
  options.tests.poison_shared = true;
  uint32_t met = 0;
  for (int64_t tile : {5, 6, 7, 9, 11, 12, 13, 20}) {
    Trial with = trial;
    with.parameters.set(entry.parameters, "tile", tile, "test");
    Exactness check(yard(), width, height, options);
    const Seen seen =
        check.expect_trials(camera_at({-3, 3, 20}, {-2, 3.5, 0}, width, height), few_and_many(), {with}, 0);
    met += seen.prepared.front().tree_cells > 0 && seen.prepared.front().list_cells > 0;
  }
  EXPECT_GT(met, 4u) << "lists and trees do not meet";
}

}  // namespace
}  // namespace ml::test
