#include "binning_cases.h"

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

}  // namespace ml::test
