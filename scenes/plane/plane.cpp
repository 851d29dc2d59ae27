#include "scenes/plane/plane.h"

#include "embedded/plane_scene_json.h"

namespace ml {
namespace {

// The same for every seed.
Scene make_plane(const SceneDescription& description, uint32_t /*seed*/) {
  MeshBuilder mesh;
  Material paint;
  paint.name = "paint";
  paint.base_color = {0.5f, 0.5f, 0.5f, 1};
  paint.roughness = 0.6f;
  uint32_t material = mesh.add_material(paint);
  mesh.quad({-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, material);
  return finish_level(mesh, description, camera_paths(description));
}

}  // namespace

SceneEntry plane_scene() {
  return {read_description("plane", plane_scene_json), make_plane};
}

}  // namespace ml
