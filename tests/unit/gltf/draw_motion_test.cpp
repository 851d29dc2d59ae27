// Where moving meshes are: as if the file had them there, and within the level's bounds.
#include "harness/scene/draw_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/random.h"
#include "tests/support/gltf_test_file.h"

namespace ml {
namespace {

using glm::dvec3;

// Two triangles: one stands still, the other is carried by a child of a node that `channels` animate.
GltfTestFile carried(const Json& rest, const Json& path_and_values) {
  GltfTestFile file = triangle_file();
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 1, 0}}});
  Json parent = rest;
  parent["children"] = {2};
  file.json["nodes"].push_back(parent);
  file.json["scenes"][0]["nodes"] = {0, 1, 3};
  Json animation = {{"channels", Json::array()}, {"samplers", Json::array()}};
  for (const auto& [path, values] : path_and_values.items()) {
    const auto numbers = values.get<std::vector<float>>();
    const size_t width = path == "rotation" ? 4 : 3;
    std::vector<float> times;
    for (size_t k = 0; k < numbers.size() / width; ++k) times.push_back(static_cast<float>(k));
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", 3}, {"path", path}}}});
    animation["samplers"].push_back({{"input", file.floats(times, "SCALAR")},
                                     {"output", file.floats(numbers, width == 4 ? "VEC4" : "VEC3")}});
  }
  if (!animation["channels"].empty()) file.json["animations"] = Json::array({animation});
  return file;
}

const Draw& moving_draw(const Scene& scene) {
  for (const Draw& draw : scene.draws)
    if (draw.motion >= 0) return draw;
  ADD_FAILURE() << "nothing moves";
  return scene.draws[0];
}

// A corner of the draw in the file's own world.
dvec3 corner_at(const Scene& scene, const Draw& draw, uint32_t corner, double time) {
  const DrawPose pose = pose_of(scene, draw, time);
  const glm::vec3 p = scene.vertices[scene.indices[draw.first_index + corner]].position;
  return dvec3(pose.linear * (p - pose.pivot) + pose.moved_pivot) + scene.origin;
}

TEST(DrawMotion, IsAsIfTheFileHadItThere) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<float> translations, rotations, scales;
    for (int key = 0; key < 3; ++key) {
      for (int c = 0; c < 3; ++c) translations.push_back(random.uniform(-20, 20));
      for (int c = 0; c < 4; ++c) rotations.push_back(random.uniform(-1, 1));
      for (int c = 0; c < 3; ++c) scales.push_back(random.uniform(0.2f, 3));
    }
    const Scene scene =
        carried(Json::object(), {{"translation", translations}, {"rotation", rotations}, {"scale", scales}})
            .load();
    ASSERT_EQ(scene.draws.size(), 2u);
    for (uint32_t key = 0; key < 3; ++key) {
      auto part = [&](const std::vector<float>& all, uint32_t width) {
        return std::vector<float>(all.begin() + key * width, all.begin() + (key + 1) * width);
      };
      const Scene still = carried({{"translation", part(translations, 3)},
                                   {"rotation", part(rotations, 4)},
                                   {"scale", part(scales, 3)}},
                                  Json::object())
                              .load();
      for (uint32_t corner = 0; corner < 3; ++corner) {
        const dvec3 here = corner_at(scene, moving_draw(scene), corner, key);
        EXPECT_LT(glm::length(here - corner_of(still, 1, corner)), 1e-4) << "key " << key;
        const dvec3 inside = here - scene.origin;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(inside[axis], scene.bounds.min[axis] - 1e-4);
          EXPECT_LE(inside[axis], scene.bounds.max[axis] + 1e-4);
        }
      }
    }
  }
}

// A node that begins with scale 0 grows later, and one that ends with it is not drawn then.
TEST(DrawMotion, ScaleZeroIsNotSeen) {
  const Scene scene = carried(Json::object(), {{"scale", {0, 0, 0, 2, 2, 2, 0, 0, 0}}}).load();
  const Draw& draw = moving_draw(scene);
  EXPECT_FALSE(pose_of(scene, draw, 0).seen);
  EXPECT_TRUE(pose_of(scene, draw, 1).seen);
  EXPECT_FALSE(pose_of(scene, draw, 2).seen);
  EXPECT_LT(glm::length(corner_at(scene, draw, 2, 1) - dvec3(8, 2, 0)), 1e-5);
}

TEST(DrawMotion, WhatStandsStillHasNone) {
  const Scene scene = carried({{"translation", {1, 2, 3}}}, Json::object()).load();
  EXPECT_TRUE(scene.draw_motions.empty());
  EXPECT_EQ(scene.draws.size(), 1u);
  EXPECT_FALSE(scene.motions);
}

}  // namespace
}  // namespace ml
