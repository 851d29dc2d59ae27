// Meshes that nodes carry, on the device: as if the level had been made with them there.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 96, height = 54;

class MovingMesh : public DeviceTest {
 protected:
  struct View {
    std::vector<float> position, normal;
  };
  static View look(const Scene& scene, double time, bool motion) {
    DeviceFrame frame(device(), scene, {.effects = {.motion = motion}}, width, height);
    FrameInput input;
    input.time = time;
    input.view = view_data(camera_at({0, 4, 12}, {0, 1, 0}, width, height), width, height, 0);
    frame.load(input);
    return {frame.read_aov(DeviceFrame::Aov::position), frame.read_aov(DeviceFrame::Aov::normal)};
  }
};

// A floor, and a box as the last draw.
Scene floor_and_box() {
  HandMadeScene made;
  Material other;
  other.name = "other";
  other.double_sided = true;
  const uint32_t material = made.material(other);
  made.rectangle({-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  made.box({-1, 0, -1}, {1, 2, 1}, material);
  return made.finish();
}

// The box turns about y, is stretched and moves, from second 0 to 2.
Scene with_moving_box(const Pose& begin, const Pose& end) {
  Scene scene = floor_and_box();
  auto channel = [](MotionChannel::Target target, std::vector<double> values) {
    return MotionChannel{target, MotionChannel::Interpolation::linear, {0, 2}, std::move(values)};
  };
  MotionNode node;
  node.channels.push_back(channel(MotionChannel::Target::translation,
                                  {begin.translation.x, begin.translation.y, begin.translation.z,
                                   end.translation.x, end.translation.y, end.translation.z}));
  node.channels.push_back(channel(MotionChannel::Target::rotation,
                                  {begin.rotation.x, begin.rotation.y, begin.rotation.z, begin.rotation.w,
                                   end.rotation.x, end.rotation.y, end.rotation.z, end.rotation.w}));
  node.channels.push_back(channel(MotionChannel::Target::scale, {begin.scale.x, begin.scale.y, begin.scale.z,
                                                                 end.scale.x, end.scale.y, end.scale.z}));
  auto motions = std::make_shared<NodeMotions>();
  scene.draw_motions.push_back({motions->add(node), glm::dmat4(1), {0, 1, 0}});
  scene.draws.back().motion = 0;
  scene.motions = motions;
  return scene;
}

Scene with_box_at(const Pose& pose) {
  Scene scene = floor_and_box();
  const glm::mat4 matrix(matrix_of(pose));
  const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(matrix)));
  for (size_t i = 4; i < scene.vertices.size(); ++i) {
    Vertex& vertex = scene.vertices[i];
    vertex.position = glm::vec3(matrix * glm::vec4(vertex.position, 1));
    vertex.normal = glm::normalize(normals * vertex.normal);
  }
  if (glm::determinant(glm::mat3(matrix)) < 0)
    for (size_t i = scene.draws.back().first_index; i < scene.indices.size(); i += 3)
      std::swap(scene.indices[i], scene.indices[i + 1]);
  return scene;
}

class MovingMeshPoses : public MovingMesh {
 protected:
  static void expect_seen_there(const Pose& end, bool double_sided) {
    Scene moving = with_moving_box({}, end);
    for (Material& material : moving.materials) material.double_sided = double_sided;
    for (bool at_end : {false, true}) {
      Scene there = with_box_at(at_end ? end : Pose{});
      for (Material& material : there.materials) material.double_sided = double_sided;
      const View seen = look(moving, at_end ? 2 : 0, true), truth = look(there, 0, false);
      uint32_t differ = 0, same = 0;
      for (size_t pixel = 0; pixel < size_t{width} * height; ++pixel) {
        double apart = 0;
        for (size_t c = 0; c < 4; ++c) {
          apart = std::max(
              apart, std::abs(double{seen.position[4 * pixel + c]} - double{truth.position[4 * pixel + c]}));
          if (c < 3)
            apart = std::max(
                apart, std::abs(double{seen.normal[4 * pixel + c]} - double{truth.normal[4 * pixel + c]}));
        }
        ++(apart > 2e-3 ? differ : same);
      }
      EXPECT_LT(differ, 8u) << "but for the box's outline";
      EXPECT_GT(same, 5000u);
    }
  }
};

TEST_F(MovingMeshPoses, AreSeenWhereTheNodeCarriesThem) {
  const double half = std::sin(0.35);
  const glm::dvec4 rotation = glm::normalize(glm::dvec4(0.1, half, 0.05, std::sqrt(1 - half * half)));
  expect_seen_there({{2, 0.5, -1}, rotation, {1.5, 0.6, 2}}, true);
  expect_seen_there({{2, 0.5, -1}, rotation, {1.5, 0.6, 2}}, false);
}

// An odd number of axes of negative scale turns triangles over: fronts stay fronts, also where backs are culled.
TEST_F(MovingMeshPoses, MirroredKeepTheirFronts) {
  for (bool double_sided : {false, true}) {
    SCOPED_TRACE(double_sided);
    expect_seen_there({{2, 0.5, -1}, {0, 0, 0, 1}, {-1.5, 0.6, 2}}, double_sided);
    expect_seen_there({{-1, 2.5, 0}, {0, 0, 0, 1}, {1.5, -0.6, 1}}, double_sided);
    expect_seen_there({{-1, 2.5, 0}, {0, 0, 0, 1}, {-1, -0.6, 1}}, double_sided);
  }
}

// What stands still beside what moves has the bits of a level in which nothing moves.
TEST_F(MovingMesh, WhatStandsStillKeepsItsBits) {
  const Scene moving = with_moving_box({}, {});
  const View seen = look(moving, 1, true), truth = look(floor_and_box(), 0, false);
  EXPECT_EQ(seen.position, truth.position);
  EXPECT_EQ(seen.normal, truth.normal);
}

}  // namespace
}  // namespace ml::test
