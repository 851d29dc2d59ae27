#include "scenes/canyon/canyon.h"

#include "embedded/canyon_scene_json.h"
#include "scenes/canyon/parts.h"

namespace ml {
namespace {

Scene make_canyon(const SceneDescription& description, uint32_t seed) {
  MeshBuilder mesh;
  CanyonMaterials materials;
  const auto add = adder_of_materials(mesh);
  materials.rock = add("rock", {0.36f, 0.28f, 0.22f}, 0, 0.9f);
  materials.sand = add("sand", {0.58f, 0.47f, 0.32f}, 0, 0.97f);
  materials.concrete = add("concrete", {0.5f, 0.5f, 0.48f}, 0, 0.7f);
  materials.metal = add("metal", {0.6f, 0.58f, 0.55f}, 1, 0.35f);
  materials.wood = add("wood", {0.42f, 0.26f, 0.13f}, 0, 0.55f);

  CanyonGround ground(seed, canyon_footprints());
  std::vector<CameraPath> paths =
      camera_paths(description, [&](double x, double z) { return ground.height(x, z); });
  const std::vector<glm::dvec3> keep_clear = paths[0].positions(400);

  ground.build(mesh, materials);
  for (double side : {-1.0, 1.0}) build_fort(mesh, materials, canyon_fort(side));
  for (const Tunnel& tunnel : {kNorthTunnel, kSouthTunnel}) build_tunnel(mesh, materials, tunnel);
  build_bridge(mesh, materials);
  build_rocks(mesh, materials, ground, seed, keep_clear);

  return finish_level(mesh, description, std::move(paths));
}

}  // namespace

SceneEntry canyon_scene() {
  return {read_description("canyon", canyon_scene_json), make_canyon};
}

}  // namespace ml
