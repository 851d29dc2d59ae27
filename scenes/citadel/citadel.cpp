#include "scenes/citadel/citadel.h"

#include "embedded/citadel_scene_json.h"
#include "scenes/citadel/parts.h"

namespace ml {
namespace {

CitadelMaterials add_materials(MeshBuilder& mesh) {
  const auto add = adder_of_materials(mesh);
  CitadelMaterials materials;
  materials.grass = add("grass", {0.2f, 0.3f, 0.1f}, 0, 0.95f);
  materials.earth = add("earth", {0.4f, 0.31f, 0.2f}, 0, 0.97f);
  materials.cobbles = add("cobbles", {0.33f, 0.31f, 0.29f}, 0, 0.6f);
  materials.stone = add("stone", {0.47f, 0.44f, 0.39f}, 0, 0.8f);
  materials.trim = add("trim", {0.56f, 0.53f, 0.48f}, 0, 0.75f);
  materials.metal = add("metal", {0.58f, 0.57f, 0.55f}, 1, 0.35f);
  materials.wood = add("wood", {0.3f, 0.19f, 0.1f}, 0, 0.7f);
  materials.needles = add("needles", {0.08f, 0.18f, 0.08f}, 0, 0.9f);
  materials.plaster[0] = add("plaster", {0.7f, 0.66f, 0.56f}, 0, 0.85f);
  materials.plaster[1] = add("yellow plaster", {0.68f, 0.54f, 0.32f}, 0, 0.85f);
  materials.plaster[2] = add("red plaster", {0.55f, 0.32f, 0.24f}, 0, 0.85f);
  materials.tiles[0] = add("tiles", {0.45f, 0.16f, 0.09f}, 0, 0.65f);
  materials.tiles[1] = add("slate", {0.19f, 0.21f, 0.25f}, 0, 0.45f);
  return materials;
}

Scene make_citadel(const SceneDescription& description, uint32_t seed) {
  MeshBuilder mesh;
  CitadelMaterials materials = add_materials(mesh);
  HeightField ground = make_citadel_ground(seed);
  std::vector<CameraPath> paths =
      camera_paths(description, [&](double x, double z) { return ground.height(x, z); });
  const std::vector<glm::dvec3> keep_clear = paths[0].positions(400);

  build_ground(mesh, materials, ground);
  build_ring_wall(mesh, materials);
  build_keep(mesh, materials);
  Random town(hash_u32(seed, 11)), fields(hash_u32(seed, 12)), woods(hash_u32(seed, 13));
  build_town(mesh, materials, ground, town);
  std::vector<glm::dvec2> farms = build_farms(mesh, materials, ground, fields, keep_clear);
  build_conifers(mesh, materials, ground, woods, keep_clear, farms);

  return finish_level(mesh, description, std::move(paths));
}

}  // namespace

SceneEntry citadel_scene() {
  return {read_description("citadel", citadel_scene_json), make_citadel};
}

}  // namespace ml
