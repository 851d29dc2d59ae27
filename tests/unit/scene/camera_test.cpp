#include "harness/scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/base/random.h"

namespace ml {
namespace {

void expect_basis(const Camera& camera) {
  EXPECT_NEAR(glm::length(camera.right), 1, 1e-6);
  EXPECT_NEAR(glm::length(camera.up), 1, 1e-6);
  EXPECT_NEAR(glm::length(camera.forward), 1, 1e-6);
  EXPECT_LT(glm::length(glm::cross(camera.right, camera.up) + camera.forward), 2e-6f);
}

Projection window() {
  return Projection::perspective(1, 1.5f, 0.1f, 100);
}

TEST(Camera, LooksAtItsTargetWithAnOrthonormalBasis) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    double size = std::pow(10.0, random.uniform(-6, 6));
    glm::dvec3 from(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    glm::dvec3 to(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    Camera camera = Camera::look_at(from * size, to * size, window());
    expect_basis(camera);
    EXPECT_GT(glm::dot(glm::dvec3(camera.forward), glm::normalize(to - from)), 1 - 1e-6);
    EXPECT_GE(camera.up.y, -1e-3f);
    EXPECT_NEAR(camera.right.y, 0, 1e-3);
    EXPECT_EQ(camera.position, glm::vec3(from * size));
  }
}

TEST(Camera, StraightUpAndDownAreAllowed) {
  for (double y : {-1.0, 1.0}) {
    for (double lean : {0.0, 1e-300, 1e-12, 1e-6, 1e-4, 1e-3}) {
      Camera camera = Camera::look_at({1, 2, 3}, {1 + lean, 2 + y, 3}, window());
      expect_basis(camera);
      EXPECT_NEAR(camera.forward.y, y, 1e-5);
    }
  }
}

TEST(Camera, WithoutADirectionItLooksAlongMinusZ) {
  double nan = std::nan("");
  for (glm::dvec3 target : {glm::dvec3(4, 5, 6), glm::dvec3(nan, 0, 0)}) {
    Camera camera = Camera::look_at({4, 5, 6}, target, window());
    EXPECT_EQ(camera.forward, glm::vec3(0, 0, -1));
    EXPECT_EQ(camera.right, glm::vec3(1, 0, 0));
    EXPECT_EQ(camera.up, glm::vec3(0, 1, 0));
  }
  // Distances whose squares leave the range of double still have a direction.
  EXPECT_EQ(Camera::look_at({0, 0, 0}, {1e-200, 0, 0}, window()).forward, glm::vec3(1, 0, 0));
  EXPECT_EQ(Camera::look_at({0, 0, 0}, {-1e200, 0, 0}, window()).forward, glm::vec3(-1, 0, 0));
}

TEST(Projection, WindowFollowsFieldOfViewAndAspect) {
  Projection p = Projection::perspective(1.5707964f, 2, 0.5f, 50);
  EXPECT_NEAR(p.top, 1, 1e-6);
  EXPECT_NEAR(p.right, 2, 1e-6);
  EXPECT_EQ(p.left, -p.right);
  EXPECT_EQ(p.bottom, -p.top);
  EXPECT_EQ(p.near, 0.5f);
  EXPECT_EQ(p.far, 50);
  Projection o = Projection::orthographic(3, 4, 1, 2);
  EXPECT_EQ(o.kind, ProjectionKind::orthographic);
  EXPECT_EQ(o.right, 3);
  EXPECT_EQ(o.bottom, -4);
}

CameraPath path_of(const std::vector<double>& times) {
  CameraPath path;
  Random random(9);
  for (double time : times) {
    path.keys.push_back(
        {time, {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)}, {0, 0, 100}});
  }
  return path;
}

TEST(CameraPath, PassesThroughItsKeys) {
  CameraPath path = path_of({2, 3, 4, 7, 8, 10});
  for (const CameraKey& key : path.keys) {
    auto frame = static_cast<uint32_t>(key.time - 2);
    glm::vec3 at = path.sample(frame, 9, 160, 90, 0.1f, 100).position;
    EXPECT_LT(glm::length(at - glm::vec3(key.position)), 1e-5f) << key.time;
  }
}

TEST(CameraPath, EndsAreExactlyTheFirstAndTheLastKey) {
  CameraPath path = path_of({0.1, 0.7, 1.9});
  for (uint32_t frames : {2u, 3u, 16u, 2400u}) {
    EXPECT_EQ(path.sample(0, frames, 16, 9, 0.1f, 10).position, glm::vec3(path.keys.front().position));
    EXPECT_EQ(path.sample(frames - 1, frames, 16, 9, 0.1f, 10).position,
              glm::vec3(path.keys.back().position));
  }
  EXPECT_EQ(path.sample(0, 1, 16, 9, 0.1f, 10).position, glm::vec3(path.keys.front().position));
}

// A straight line at constant speed is reproduced whatever the spacing of the keys: the spline is linear in
// time.
TEST(CameraPath, KeepsConstantSpeedOverUnevenKeys) {
  CameraPath path;
  for (double t : {0.0, 1.0, 1.5, 4.0, 10.0}) path.keys.push_back({t, {3 * t, -t, 2}, {3 * t + 1, -t, 2}});
  for (uint32_t frame = 0; frame < 101; ++frame) {
    glm::vec3 at = path.sample(frame, 101, 16, 9, 0.1f, 10).position;
    EXPECT_NEAR(at.x, 0.3 * frame, 1e-4);
    EXPECT_NEAR(at.y, -0.1 * frame, 1e-4);
  }
}

TEST(CameraPath, VelocityHasNoJumps) {
  CameraPath path = path_of({0, 1, 2, 3.5, 4, 6});
  constexpr uint32_t kFrames = 6001;
  glm::dvec3 last(0), last_step(0);
  double largest_step = 0, largest_change = 0;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    glm::dvec3 at(path.sample(frame, kFrames, 16, 9, 0.1f, 10).position);
    glm::dvec3 step = at - last;
    if (frame > 0) largest_step = std::max(largest_step, glm::length(step));
    if (frame > 1) largest_change = std::max(largest_change, glm::length(step - last_step));
    last = at;
    last_step = step;
  }
  EXPECT_LT(largest_change, 0.02 * largest_step);
}

TEST(CameraPath, OneKeyStandsStill) {
  CameraPath path = path_of({5});
  EXPECT_EQ(path.duration(), 0);
  for (uint32_t frame : {0u, 3u, 15u}) {
    EXPECT_EQ(path.sample(frame, 16, 16, 9, 0.1f, 10).position, glm::vec3(path.keys[0].position));
  }
}

TEST(CameraPath, AFilesProjectionKeepsItsHeightAndOffsets) {
  CameraPath path = path_of({0});
  path.has_projection = true;
  path.projection = {ProjectionKind::perspective, -0.2f, 0.6f, -0.3f, 0.5f, 0.25f, 77};
  Projection p = path.sample(0, 1, 300, 100, 0.1f, 10).projection;
  EXPECT_EQ(p.top, 0.5f);
  EXPECT_EQ(p.bottom, -0.3f);
  EXPECT_EQ(p.near, 0.25f);
  EXPECT_EQ(p.far, 77);
  EXPECT_NEAR((p.right - p.left) / (p.top - p.bottom), 3, 1e-5);
  EXPECT_NEAR(p.left / p.right, -0.2 / 0.6, 1e-5);
}

}  // namespace
}  // namespace ml
