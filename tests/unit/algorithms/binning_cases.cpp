#include "binning_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ml::test {

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
  settings.ball_test = random.below(2) != 0;
  settings.narrow = random.below(2) != 0;
  settings.chords = settings.ball_test && random.below(2) != 0;
  return settings;
}

BinningFrame::BinningFrame(const std::vector<Light>& lights, const Camera& camera, uint32_t width,
                           uint32_t height, unsigned count)
    : threads(count) {
  storage.fill(lights, camera.position);
  frame.view = view_data(camera, width, height, static_cast<uint32_t>(lights.size()));
  frame.lights = storage.lights();
  frame.threads = &threads;
}

glm::dvec3 point_at(const gpu_data::ViewData& view, uint32_t x, uint32_t y, double depth) {
  double u = (x + 0.5) / view.resolution.x, v = (y + 0.5) / view.resolution.y;
  double wx = view.left_edge + u * (static_cast<double>(view.right_edge) - view.left_edge);
  double wy = view.top_edge + v * (static_cast<double>(view.bottom_edge) - view.top_edge);
  double scale = view.orthographic ? 1 : depth;
  return glm::dvec3(view.right) * (wx * scale) + glm::dvec3(view.up) * (wy * scale) +
         glm::dvec3(view.forward) * depth;
}

void expect_no_light_lost(Random& random, const FrameInput& frame, const FroxelGrid& grid, uint32_t samples,
                          const LightsAt& lights_at) {
  const gpu_data::ViewData& view = frame.view;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    const uint32_t x = random.below(view.resolution.x), y = random.below(view.resolution.y);
    const float depth = log_uniform(random, view.near, std::min(view.far, 1000.0f));
    const glm::dvec3 point = point_at(view, x, y, static_cast<double>(depth));
    const uint32_t cell =
        grid.cell(x / grid.tile, y / grid.tile, gpu_data::slice_of_depth(depth, grid.mapping));
    std::vector<uint32_t> found = lights_at(cell, depth);
    std::ranges::sort(found);
    ASSERT_TRUE(std::ranges::adjacent_find(found) == found.end()) << "a light twice in cell " << cell;
    for (uint32_t light = 0; light < frame.lights.count(); ++light) {
      const gpu_data::LightCore& core = frame.lights.core[light];
      const bool inside = glm::distance(glm::dvec3(core.position), point) < static_cast<double>(core.radius);
      ASSERT_TRUE(!inside || std::ranges::binary_search(found, light))
          << "light " << light << ", pixel " << x << "," << y << ", depth " << depth;
    }
  }
}

std::vector<Light> random_small_lights(Random& random, uint32_t count, const Camera& camera) {
  std::vector<Light> lights = random_lights(random, count, camera);
  for (Light& light : lights) light.radius *= 0.05f;
  return lights;
}

}  // namespace ml::test
