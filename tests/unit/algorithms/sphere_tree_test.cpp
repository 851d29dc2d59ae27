// The tree of light_bvh: every light once, bounds that hold what is below, at most as many children as asked,
// whatever is done to it; and the packed walk reaches every light that holds a point.
#include "algorithms/light_bvh/sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "algorithms/light_bvh/packing.h"
#include "binning_cases.h"
#include "random_shapes.h"

namespace ml {
namespace {

using namespace test;

struct MovingLights {
  std::vector<Light> lights;
  FrameLightStorage storage;
  FrameLights now;
  // All of them balls, or of all shapes in turn.
  MovingLights(Random& random, uint32_t count, bool shapes = false) : lights(random_shapes(count, random)) {
    for (Light& light : lights) {
      light.position = {random.uniform(-50, 50), random.uniform(-5, 5), random.uniform(-50, 50)};
      if (!shapes) light.shape = LightShape::omni;
      if (light.shape == LightShape::box)
        make_box(light, glm::min(light.half_extents, glm::vec3(8)));
      else
        light.radius = log_uniform(random, 0.1f, 8);
      light.half_length = std::min(light.half_length, 8.0f);
    }
    fill();
  }
  void move(Random& random, float max_step) {
    for (Light& light : lights)
      light.position += glm::dvec3(random.uniform(-max_step, max_step), random.uniform(-max_step, max_step),
                                   random.uniform(-max_step, max_step));
    fill();
  }
  void fill() {
    storage.fill(lights, glm::vec3(0));
    now = storage.lights();
  }
};

void expect_sound(const SphereTree& tree, const FrameLights& lights, uint32_t branching) {
  std::set<uint32_t> seen;
  for (uint32_t node : tree.bottom_up()) {
    const SphereTree::Node& n = tree[node];
    if (n.light != SphereTree::none) {
      EXPECT_TRUE(seen.insert(n.light).second) << "light " << n.light << " twice";
      const VolumeBox box = volume_of(lights, n.light).box;
      EXPECT_EQ(n.box.low, box.low);
      EXPECT_EQ(n.box.high, box.high);
      continue;
    }
    EXPECT_GE(n.children, 2u);
    EXPECT_LE(n.children, branching);
    for (uint32_t c = 0; c < n.children; ++c) {
      const SphereTree::Node& child = tree[n.child[c]];
      EXPECT_EQ(child.parent, node);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(n.box.low[axis], child.box.low[axis]);
        EXPECT_GE(n.box.high[axis], child.box.high[axis]);
      }
    }
  }
  EXPECT_EQ(seen.size(), lights.count());
}

// Lights of the leaves that a point reaches.
std::set<uint32_t> walk(std::span<const PackedNode> nodes, const glm::vec3& point) {
  std::set<uint32_t> lights;
  for (uint32_t i = 0; i < nodes.size();) {
    const bool hit = glm::distance(nodes[i].center, point) <= nodes[i].radius;
    if (hit && nodes[i].light != packed_inner) lights.insert(nodes[i].light);
    i = hit ? i + 1 : nodes[i].miss;
  }
  return lights;
}

// Every light is found from the points that it reaches.
void expect_complete(const SphereTree& tree, const MovingLights& lights, Random& random) {
  const auto count = static_cast<uint32_t>(lights.lights.size());
  std::vector<uint8_t> visible(count);
  for (uint8_t& flag : visible) flag = random.below(4) != 0;
  SpherePacking packing;
  packing.build(tree, visible);
  for (int sample = 0; sample < 100 && count > 0; ++sample) {
    const uint32_t light = random.below(count);
    if (!visible[light]) continue;
    const glm::vec3 point(random_point_in(random, lights.lights[light]));
    EXPECT_TRUE(walk(packing.nodes(), point).contains(light)) << light;
  }
}

TEST(SphereTree, StaysSoundWhateverIsDoneToIt) {
  for (uint32_t branching = 2; branching <= 8; ++branching)
    for (uint32_t count : {0u, 1u, 2u, 3u, 9u, 500u}) {
      Random random(branching * 1000 + count);
      MovingLights lights(random, count, branching % 2 == 0);
      SphereTree tree(branching);
      tree.build(lights.now);
      expect_sound(tree, lights.now, branching);
      for (uint32_t frame = 1; frame < 12; ++frame) {
        lights.move(random, 2);
        tree.follow(lights.now);
        expect_sound(tree, lights.now, branching);
        tree.reinsert(frame % 4, 4);
        expect_sound(tree, lights.now, branching);
        expect_complete(tree, lights, random);
      }
    }
}

TEST(SphereTree, LightsComeAndGo) {
  for (uint32_t branching : {2u, 3u, 8u})
    for (uint32_t count : {1u, 2u, 5u, 40u, 600u}) {
      Random random(branching * 1000 + count);
      MovingLights scene(random, count);
      SphereTree tree(branching);
      MovingLights now(random, 0);
      std::vector<uint32_t> identity;
      std::vector<uint8_t> shines(count, 1);
      for (uint32_t frame = 0; frame < 40; ++frame) {
        // Mostly a few, at times half of them, and once all.
        const uint32_t change = frame == 20 ? 1 : frame % 7 == 0 ? 2 : 16;
        for (uint8_t& flag : shines)
          if (random.below(change) == 0) flag = !flag;
        scene.move(random, 1);
        now.lights.clear();
        identity.clear();
        for (uint32_t i = 0; i < count; ++i)
          if (shines[i]) {
            now.lights.push_back(scene.lights[i]);
            identity.push_back(i);
          }
        now.fill();
        now.now.identity = identity;
        tree.follow(now.now);
        ASSERT_EQ(tree.lights(), now.lights.size());
        expect_sound(tree, now.now, branching);
        tree.reinsert(frame % 4, 4);
        expect_sound(tree, now.now, branching);
        expect_complete(tree, now, random);
        if (testing::Test::HasFailure()) return;
      }
    }
}

TEST(SphereTree, LightsAtOnePointEndSomewhere) {
  Random random(1);
  MovingLights lights(random, 5000);
  for (Light& light : lights.lights) light.position = {1, 2, 3}, light.radius = 2;
  lights.fill();
  SphereTree tree(8);
  tree.build(lights.now);
  expect_sound(tree, lights.now, 8);
  tree.reinsert(0, 16);
  expect_sound(tree, lights.now, 8);
}

TEST(SphereTree, RefittingAnUnchangedFrameChangesNothing) {
  Random random(2);
  MovingLights lights(random, 300);
  SphereTree tree(8);
  tree.build(lights.now);
  std::vector<uint8_t> all(300, 1);
  SpherePacking before, after;
  before.build(tree, all);
  tree.follow(lights.now);
  after.build(tree, all);
  ASSERT_EQ(before.nodes().size(), after.nodes().size());
  EXPECT_EQ(std::memcmp(before.nodes().data(), after.nodes().data(), before.nodes().size_bytes()), 0);
}

TEST(SphereTree, WhatIsOutOfViewIsNotPacked) {
  Random random(3);
  MovingLights lights(random, 200);
  SphereTree tree(4);
  tree.build(lights.now);
  SpherePacking packing;
  packing.build(tree, std::vector<uint8_t>(200, 0));
  EXPECT_TRUE(packing.nodes().empty());
  std::vector<uint8_t> one(200, 0);
  one[77] = 1;
  packing.build(tree, one);
  ASSERT_EQ(packing.nodes().size(), 1u);
  EXPECT_EQ(packing.nodes()[0].light, 77u);
}

}  // namespace
}  // namespace ml
