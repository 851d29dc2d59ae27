// How nodes move: glTF's interpolations, one clock, and what they carry.
#include "harness/scene/node_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/base/random.h"
#include "harness/lights/set.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;
using Target = MotionChannel::Target;
using Interpolation = MotionChannel::Interpolation;

MotionNode slides(std::vector<double> times, std::vector<double> x, Interpolation interpolation) {
  MotionChannel channel{Target::translation, interpolation, std::move(times), {}};
  for (double value : x) channel.values.insert(channel.values.end(), {value, 0, 0});
  MotionNode node;
  node.channels.push_back(std::move(channel));
  return node;
}

TEST(NodeMotions, InterpolateAndHoldTheirEnds) {
  NodeMotions motions;
  motions.add(slides({1, 2, 4}, {0, 10, 20}, Interpolation::linear));
  motions.add(slides({1, 2, 4}, {0, 10, 20}, Interpolation::step));
  auto x = [&](size_t node, double time) { return motions.world(node, time)[3].x; };
  EXPECT_EQ(x(0, -5), 0);
  EXPECT_EQ(x(0, 1.5), 5);
  EXPECT_EQ(x(0, 3), 15);
  EXPECT_EQ(x(0, 9), 20);
  EXPECT_EQ(x(1, 1.999999), 0);
  EXPECT_EQ(x(1, 2), 10);
  EXPECT_EQ(x(1, 3.999), 10);
  EXPECT_EQ(x(1, 4), 20);
}

TEST(NodeMotions, OneClockForAll) {
  NodeMotions motions;
  motions.add(slides({1, 2}, {0, 1}, Interpolation::linear));
  motions.add(slides({0.5, 7}, {0, 1}, Interpolation::linear));
  motions.add(MotionNode());
  EXPECT_EQ(motions.begin(), 0.5);
  EXPECT_EQ(motions.end(), 7);
  EXPECT_EQ(motions.time_of(0, 14), 0.5);
  EXPECT_EQ(motions.time_of(13, 14), 7);
  EXPECT_EQ(motions.time_of(3, 14), 2);
  EXPECT_EQ(motions.time_of(0, 1), 0.5);
  EXPECT_FALSE(motions.moves(2));
}

// A key's time that falls on a frame is that frame's time, whatever the numbers: a cut is not a frame late.
TEST(NodeMotions, KeysFallOnTheirFrames) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const auto frames = 2 + random.below(1000);
    const auto frame = random.below(frames);
    // Eighths of a second, so that the key's time is a float.
    const double step = random.below(512) / 8.0, key = step * frame;
    NodeMotions motions;
    motions.add(slides({0, step * (frames - 1)}, {0, 1}, Interpolation::linear));
    EXPECT_EQ(motions.time_of(frame, frames), key) << frame << " of " << frames;
  }
}

TEST(NodeMotions, JumpsAreThoseOfStepsThatChangeSomething) {
  NodeMotions motions;
  const size_t parent = motions.add(slides({0, 1, 2}, {0, 5, 5}, Interpolation::step));
  MotionNode child;
  child.parent = static_cast<int>(parent);
  const size_t carried = motions.add(child);
  const size_t smooth = motions.add(slides({0, 1, 2}, {0, 5, 9}, Interpolation::linear));
  EXPECT_TRUE(motions.jumps(carried, 0.5, 1));
  EXPECT_FALSE(motions.jumps(carried, 1, 1.5));
  EXPECT_FALSE(motions.jumps(carried, 1.5, 2)) << "the same value again";
  EXPECT_FALSE(motions.jumps(smooth, 0.5, 1));
}

TEST(NodeMotions, SampleTimesHoldAllKeysAscending) {
  NodeMotions motions;
  MotionNode node = slides({0, 1, 5}, {0, 1, 2}, Interpolation::linear);
  const size_t parent = motions.add(slides({0.5, 1}, {0, 1}, Interpolation::linear));
  node.parent = static_cast<int>(parent);
  const std::vector<double> times = sample_times(motions, motions.add(node), 3);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  for (double key : {0.0, 0.5, 1.0, 5.0}) EXPECT_TRUE(std::count(times.begin(), times.end(), key)) << key;
  EXPECT_EQ(times.size(), 4u + 3u * 3u);
  MotionNode many = slides({}, {}, Interpolation::linear);
  for (int i = 0; i < 20000; ++i) {
    many.channels[0].times.push_back(i);
    many.channels[0].values.insert(many.channels[0].values.end(), {1.0 * i, 0, 0});
  }
  const std::vector<double> thinned = sample_times(motions, motions.add(many), 3);
  EXPECT_LE(thinned.size(), 4200u);
  EXPECT_EQ(thinned.back(), 19999);
}

// A file of one triangle and one spot whose parent turns, moves and is scaled.
GltfTestFile carried_light(const Json& path_and_values, const std::string& interpolation) {
  GltfTestFile file = triangle_file();
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array(
      {{{"type", "spot"}, {"range", 5}, {"spot", Json::object()}}, {{"type", "point"}, {"range", 5}}});
  file.json["nodes"].push_back(
      {{"translation", {1, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.json["nodes"].push_back({{"children", {2}}});
  file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  file.json["scenes"][0]["nodes"] = {0, 1, 4, 3};
  Json animation = {{"channels", Json::array()}, {"samplers", Json::array()}};
  for (const auto& [path, values] : path_and_values.items()) {
    const auto numbers = values.get<std::vector<float>>();
    const size_t width = path == "rotation" ? 4 : 3, keys = numbers.size() / width;
    std::vector<float> times;
    for (size_t k = 0; k < keys; ++k) times.push_back(static_cast<float>(k));
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", 3}, {"path", path}}}});
    animation["samplers"].push_back({{"input", file.floats(times, "SCALAR")},
                                     {"output", file.floats(numbers, width == 4 ? "VEC4" : "VEC3")},
                                     {"interpolation", interpolation}});
  }
  file.json["animations"] = Json::array({animation});
  return file;
}

LightSet own_lights(const Scene& scene) {
  LightSpec spec;
  spec.placement = Placement::gltf;
  return {spec, scene};
}

TEST(NodeMotions, CarryLights) {
  const float h = std::sqrt(0.5f);
  // Half a turn about y in two steps, then up.
  const Scene scene = carried_light({{"rotation", {0, 0, 0, 1, 0, h, 0, h, 0, 1, 0, 0}},
                                     {"translation", {0, 0, 0, 0, 0, 0, 0, 4, 0}}},
                                    "LINEAR")
                          .load();
  ASSERT_TRUE(scene.motions);
  const LightSet set = own_lights(scene);
  ASSERT_EQ(set.base().size(), 2u);
  std::vector<Light> lights;
  std::vector<uint32_t> identity;
  auto check = [&](uint32_t frame, const dvec3& position, const dvec3& direction) {
    set.at(frame, 5, 2, lights, &identity);
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(identity, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(lights[0].position + scene.origin, dvec3(0)) << "stands still";
    EXPECT_LT(glm::length(lights[1].position + scene.origin - position), 1e-6) << frame;
    EXPECT_LT(glm::length(dvec3(lights[1].direction) - direction), 1e-6) << frame;
  };
  check(0, {1, 0, 0}, {0, 0, -1});
  check(1, dvec3(h, 0, -h), dvec3(-h, 0, -h));
  check(2, {0, 0, -1}, {-1, 0, 0});
  check(3, {-h, 2, -h}, {-h, 0, h});
  check(4, {-1, 4, 0}, {0, 0, 1});
}

TEST(NodeMotions, ALightUnderScaleZeroDoesNotShineInThatFrame) {
  const Scene scene = carried_light({{"scale", {1, 1, 1, 0, 0, 0, 1, 1, 1}}}, "STEP").load();
  const LightSet set = own_lights(scene);
  EXPECT_EQ(set.account().used, 2u);
  std::vector<Light> lights;
  std::vector<uint32_t> identity;
  for (uint32_t frame = 0; frame < 3; ++frame) {
    set.at(frame, 3, 2, lights, &identity);
    EXPECT_EQ(lights.size(), frame == 1 ? 1u : 2u);
    EXPECT_EQ(identity.back(), frame == 1 ? 0u : 1u);
  }
}

TEST(NodeMotions, WhatCarriesNothingIsNamed) {
  GltfTestFile file = carried_light({{"translation", {0, 0, 0, 3, 0, 0}}}, "LINEAR");
  file.json["nodes"].push_back({{"name", "joint"}});
  file.json["scenes"][0]["nodes"].push_back(5);
  file.json["animations"][0]["channels"][0]["target"]["node"] = 5;
  const Scene scene = file.load();
  EXPECT_FALSE(scene.motions);
  EXPECT_TRUE(std::any_of(scene.notes.begin(), scene.notes.end(), [](const std::string& note) {
    return note.starts_with("1 animation channels move nodes that carry no mesh, light or camera");
  }));
}

// A camera that stands still among what moves runs by the clock of what moves.
TEST(NodeMotions, AStillCameraHasTheClocksDuration) {
  const Scene scene = carried_light({{"translation", {0, 0, 0, 3, 0, 0, 0, 4, 0}}}, "LINEAR").load();
  EXPECT_EQ(scene.paths[0].duration(), 2);
  const Camera first = scene.paths[0].sample(0, 9, 16, 9, 0.1f, 10);
  for (uint32_t frame = 0; frame < 9; ++frame) {
    const Camera camera = scene.paths[0].sample(frame, 9, 16, 9, 0.1f, 10);
    EXPECT_EQ(camera.position, first.position);
    EXPECT_EQ(camera.forward, first.forward);
    EXPECT_EQ(scene.paths[0].cuts(frame, 9), frame == 0);
  }
}

TEST(NodeMotions, WhatIsNotPlayedIsNamed) {
  GltfTestFile file = carried_light({{"translation", {0, 0, 0, 3, 0, 0}}}, "LINEAR");
  Json& channels = file.json["animations"][0]["channels"];
  channels.push_back({{"sampler", 0}, {"target", {{"node", 3}, {"path", "weights"}}}});
  channels.push_back({{"sampler", 0}, {"target", {{"path", "pointer"}}}});
  file.json["animations"].push_back(file.json["animations"][0]);
  const Scene scene = file.load();
  auto count = [&](const std::string& note) {
    return std::count(scene.notes.begin(), scene.notes.end(), note);
  };
  EXPECT_EQ(count("2 animation channels move the weights of morph targets, which is ignored"), 1);
  EXPECT_EQ(
      count("2 animation channels move something else than a node's translation, rotation or scale, and "
            "are ignored"),
      1);
  EXPECT_EQ(count("1 animation channels move nodes that an earlier animation moves, and are not played"), 1);
}

}  // namespace
}  // namespace ml
