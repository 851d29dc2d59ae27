// Clustered binning: conservative, the same as the scalar reference, independent of threads.
#include "algorithms/froxels/froxel_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/froxels/reference_lists.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/frame/frame_input.h"

namespace ml {
namespace {

constexpr uint64_t no_limit = uint64_t{1} << 28;

float log_uniform(Random& random, float low, float high) {
  return low * std::pow(high / low, random.uniform());
}

// A camera that looks somewhere, with an off-centre window; every third is orthographic.
Camera random_camera(Random& random) {
  Projection projection;
  projection.near = log_uniform(random, 0.001f, 2);
  projection.far = projection.near * log_uniform(random, 10, 1e6f);
  float size = 1;
  if (random.below(3) == 0) {
    projection.kind = ProjectionKind::orthographic;
    size = log_uniform(random, 1, 200);
  }
  float center_x = random.uniform(-1, 1), center_y = random.uniform(-1, 1);
  float half_x = log_uniform(random, 0.02f, 2), half_y = log_uniform(random, 0.02f, 2);
  projection.left = size * (center_x - half_x), projection.right = size * (center_x + half_x);
  projection.bottom = size * (center_y - half_y), projection.top = size * (center_y + half_y);
  glm::dvec3 eye(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
  glm::dvec3 target(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
  return Camera::look_at(eye, target, projection);
}

std::vector<Light> random_lights(Random& random, uint32_t count, const Camera& camera) {
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    // Around the camera at all distances, in front and behind, so that many straddle the near plane or hold
    // the camera.
    float distance = log_uniform(random, 0.01f, 500);
    glm::vec3 direction(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    light.position = glm::dvec3(camera.position) +
                     glm::dvec3(glm::normalize(direction + glm::vec3(1e-3f))) * static_cast<double>(distance);
    light.radius = distance * log_uniform(random, 0.01f, 3);
  }
  return lights;
}

FroxelSettings random_settings(Random& random) {
  FroxelSettings settings;
  settings.tile = 4 + random.below(60);
  settings.slices = 1 + random.below(40);
  settings.zmin = log_uniform(random, 0.1f, 50);
  settings.zmax = random.below(2) ? settings.zmin * log_uniform(random, 1.5f, 1000) : 0;
  settings.refinement = random.below(2) != 0;
  return settings;
}

struct Fixture {
  Threads threads;
  FrameLightStorage storage;
  FrameInput frame;
  Fixture(const std::vector<Light>& lights, const Camera& camera, uint32_t width, uint32_t height,
          unsigned count = 1)
      : threads(count) {
    storage.fill(lights, camera.position);
    frame.view = view_data(camera, width, height, static_cast<uint32_t>(lights.size()));
    frame.lights = storage.lights();
    frame.threads = &threads;
  }
};

std::vector<uint32_t> list_of(const FroxelLists& lists, uint32_t froxel) {
  auto indices =
      lists.entries().subspan(lists.offsets()[froxel], lists.offsets()[froxel + 1] - lists.offsets()[froxel]);
  return {indices.begin(), indices.end()};
}

// The point of the view at a pixel's centre and a depth, camera-relative, in double.
glm::dvec3 point_at(const gpu_data::ViewData& view, uint32_t x, uint32_t y, double depth) {
  double u = (x + 0.5) / view.resolution.x, v = (y + 0.5) / view.resolution.y;
  double wx = view.left_edge + u * (static_cast<double>(view.right_edge) - view.left_edge);
  double wy = view.top_edge + v * (static_cast<double>(view.bottom_edge) - view.top_edge);
  double scale = view.orthographic ? 1 : depth;
  return glm::dvec3(view.right) * (wx * scale) + glm::dvec3(view.up) * (wy * scale) +
         glm::dvec3(view.forward) * depth;
}

TEST(FroxelLists, EveryLightIsListedWhereverAPixelCanSeeInsideIt) {
  for (uint32_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const uint32_t width = 1 + random.below(200), height = 1 + random.below(200);
    Camera camera = random_camera(random);
    Fixture fixture(random_lights(random, 60, camera), camera, width, height);
    FroxelSettings settings = random_settings(random);
    FroxelLists lists{"clustered"};
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    const gpu_data::ViewData& view = fixture.frame.view;
    for (uint32_t sample = 0; sample < 300; ++sample) {
      uint32_t x = random.below(width), y = random.below(height);
      float depth = log_uniform(random, view.near, std::min(view.far, 1000.0f));
      glm::dvec3 point = point_at(view, x, y, static_cast<double>(depth));
      uint32_t froxel = ((y / settings.tile) * lists.grid().columns + x / settings.tile) * settings.slices +
                        gpu_data::slice_of_depth(depth, lists.grid().mapping);
      std::vector<uint32_t> list = list_of(lists, froxel);
      for (uint32_t light = 0; light < fixture.frame.lights.count(); ++light) {
        const gpu_data::LightCore& core = fixture.frame.lights.core[light];
        bool inside = glm::distance(glm::dvec3(core.position), point) < static_cast<double>(core.radius);
        ASSERT_TRUE(!inside || std::binary_search(list.begin(), list.end(), light))
            << "seed " << seed << ", light " << light << ", pixel " << x << "," << y << ", depth " << depth;
      }
    }
  }
}

TEST(FroxelLists, VectorCodeGivesTheReferencesBits) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Random random(1000 + seed);
    Camera camera = random_camera(random);
    Fixture fixture(random_lights(random, random.below(700), camera), camera, 1 + random.below(400),
                    1 + random.below(400));
    FroxelSettings settings = random_settings(random);
    settings.refinement = false;
    FroxelLists lists{"clustered"};
    ReferenceLists reference;
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    reference.build(fixture.frame, settings);
    ASSERT_TRUE(std::ranges::equal(lists.offsets(), reference.offsets())) << "seed " << seed;
    ASSERT_TRUE(std::ranges::equal(lists.entries(), reference.entries())) << "seed " << seed;
  }
}

TEST(FroxelLists, RefinementOnlyTakesAway) {
  size_t plain = 0, refined = 0;
  for (uint32_t seed = 0; seed < 100; ++seed) {
    Random random(2000 + seed);
    Camera camera = random_camera(random);
    Fixture fixture(random_lights(random, 200, camera), camera, 320, 180);
    FroxelSettings settings = random_settings(random);
    FroxelLists with{"clustered"}, without{"clustered"};
    Spans spans;
    settings.refinement = true;
    with.build(fixture.frame, settings, no_limit, spans);
    settings.refinement = false;
    without.build(fixture.frame, settings, no_limit, spans);
    plain += without.entries().size();
    refined += with.entries().size();
    for (uint32_t froxel = 0; froxel < with.grid().cells(); ++froxel) {
      std::vector<uint32_t> fewer = list_of(with, froxel), more = list_of(without, froxel);
      ASSERT_TRUE(std::ranges::includes(more, fewer)) << "seed " << seed << ", froxel " << froxel;
    }
  }
  EXPECT_LT(refined, plain);
}

TEST(FroxelLists, DoNotDependOnTheNumberOfThreads) {
  for (uint32_t count : {0u, 1u, 2047u, 4096u, 65535u, 65536u, 65537u}) {
    Random random(count);
    Camera camera = random_camera(random);
    std::vector<Light> lights = random_lights(random, count, camera);
    for (Light& light : lights) light.radius *= 0.05f;
    for (bool refinement : {false, true}) {
      FroxelSettings settings;
      settings.refinement = refinement;
      std::vector<std::vector<uint32_t>> results;
      for (unsigned threads : {1u, 2u, 7u}) {
        Fixture fixture(lights, camera, 640, 360, threads);
        FroxelLists lists{"clustered"};
        Spans spans;
        lists.build(fixture.frame, settings, no_limit, spans);
        results.emplace_back(lists.offsets().begin(), lists.offsets().end());
        results.back().insert(results.back().end(), lists.entries().begin(), lists.entries().end());
      }
      ASSERT_EQ(results[0], results[1]) << count;
      ASSERT_EQ(results[0], results[2]) << count;
    }
  }
}

TEST(FroxelLists, AFrameWithFewerLightsLeavesNothingBehind) {
  Random random(5);
  Camera camera = random_camera(random);
  std::vector<Light> many = random_lights(random, 5000, camera), few(many.begin(), many.begin() + 10);
  Fixture large(many, camera, 640, 360), small(few, camera, 64, 64);
  FroxelSettings settings;
  FroxelLists reused{"clustered"}, fresh{"clustered"};
  Spans spans;
  reused.build(large.frame, settings, no_limit, spans);
  reused.build(small.frame, settings, no_limit, spans);
  fresh.build(small.frame, settings, no_limit, spans);
  EXPECT_TRUE(std::ranges::equal(reused.offsets(), fresh.offsets()));
  EXPECT_TRUE(std::ranges::equal(reused.entries(), fresh.entries()));
}

TEST(FroxelLists, MoreEntriesThanTheLimitAreRefusedBeforeMemoryIsTaken) {
  Camera camera;
  camera.projection = Projection::perspective(1, 1, 0.1f, 100);
  std::vector<Light> lights(65536);
  for (Light& light : lights) light.radius = 1000;  // each covers the whole view
  Fixture fixture(lights, camera, 1920, 1080);
  FroxelLists lists{"clustered"};
  Spans spans;
  for (bool refinement : {false, true}) {
    FroxelSettings settings;
    settings.refinement = refinement;
    EXPECT_THROW(lists.build(fixture.frame, settings, 1 << 25, spans), SystemError);
  }
}

TEST(FroxelLists, AllLightsInOneFroxel) {
  Camera camera;
  camera.projection = Projection::perspective(1, 1, 0.1f, 100);
  for (uint32_t count : {65535u, 65536u, 65537u}) {
    std::vector<Light> lights(count);
    for (Light& light : lights) light.position = {0.3, 0.3, -3}, light.radius = 0.1f;
    Fixture fixture(lights, camera, 64, 64);
    FroxelSettings settings;
    settings.tile = 64;
    FroxelLists lists{"clustered"};
    Spans spans;
    lists.build(fixture.frame, settings, no_limit, spans);
    EXPECT_EQ(lists.entries().size(), count);
  }
}

}  // namespace
}  // namespace ml
