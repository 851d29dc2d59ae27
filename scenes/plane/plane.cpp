#include "harness/scene/mesh_builder.h"
#include "scenes/procedural.h"

namespace ml {

Scene make_plane() {
  MeshBuilder mesh;
  Material paint;
  paint.name = "paint";
  paint.base_color = {0.5f, 0.5f, 0.5f, 1};
  paint.roughness = 0.6f;
  uint32_t material = mesh.add_material(paint);
  mesh.quad({-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, material);

  Scene scene = mesh.finish_level("plane", kPlaneLights, 200, {});
  CameraPath glide;
  glide.name = "default";
  glide.keys = {{0, {-20, 25, 20}, {-8, 0, 6}},
                {5, {15, 22, 20}, {6, 0, 6}},
                {10, {20, 28, -15}, {6, 0, -5}},
                {15, {-15, 20, -18}, {-6, 0, -6}},
                {20, {0, 12, 10}, {0, 0, 0}}};
  CameraPath above;
  above.name = "above";
  above.keys = {{0, {0, 40, 0}, {0, 0, 0}}};
  scene.paths = {glide, above};
  return scene;
}

}  // namespace ml
