#include "scenes/grove/grove.h"

#include "embedded/grove_scene_json.h"
#include "harness/scene/noise.h"
#include "scenes/grove/parts.h"

namespace ml {
namespace {

GroveMaterials add_materials(MeshBuilder& mesh) {
  const auto add = adder_of_materials(mesh);
  GroveMaterials materials;
  materials.grass = add("grass", {0.18f, 0.27f, 0.09f}, 0, 0.95f);
  materials.earth = add("earth", {0.43f, 0.34f, 0.23f}, 0, 0.97f);
  materials.picket = add("picket", {0.72f, 0.7f, 0.64f}, 0, 0.5f);
  materials.timber = add("timber", {0.46f, 0.38f, 0.28f}, 0, 0.7f);
  materials.iron = add("iron", {0.3f, 0.3f, 0.31f}, 1, 0.4f);
  materials.lamp = add("lamp", {0.9f, 0.85f, 0.7f}, 0, 0.2f);
  materials.bark = add("bark", {0.25f, 0.18f, 0.12f}, 0, 0.9f);
  materials.leaves[0] = add("leaves", {0.17f, 0.33f, 0.08f}, 0, 0.6f, Finish::double_sided);
  materials.leaves[1] = add("yellow leaves", {0.42f, 0.38f, 0.09f}, 0, 0.6f, Finish::double_sided);
  materials.leaves[2] = add("red leaves", {0.45f, 0.16f, 0.06f}, 0, 0.6f, Finish::double_sided);
  return materials;
}

}  // namespace

HeightField make_grove_ground(uint32_t seed) {
  constexpr int kCells = 60;
  constexpr double kCell = 5;
  uint32_t hash = hash_u32(seed);
  return HeightField(kCells, kCell, [&](double x, double z) {
    return 2.2 * rough(hash + 1, x / 55, z / 55) + 0.2 * rough(hash + 2, x / 11, z / 11);
  });
}

void build_ground(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                  const GroveWay& way) {
  ground.build(mesh, [&](double x, double z, double) {
    return way.distance({x, z}) < 3.6 ? materials.earth : materials.grass;
  });
}

namespace {

Scene make_grove(const SceneDescription& description, uint32_t seed) {
  MeshBuilder mesh;
  GroveMaterials materials = add_materials(mesh);
  HeightField ground = make_grove_ground(seed);
  GroveWay way;
  std::vector<CameraPath> paths =
      camera_paths(description, [&](double x, double z) { return ground.height(x, z); });
  const std::vector<glm::dvec3> keep_clear = paths[0].positions(400);

  build_ground(mesh, materials, ground, way);
  build_fences(mesh, materials, ground, way);
  build_lamps(mesh, materials, ground, way);
  Random woods(hash_u32(seed, 21));
  build_trees(mesh, materials, ground, way, woods, keep_clear);

  return finish_level(mesh, description, std::move(paths));
}

}  // namespace

SceneEntry grove_scene() {
  return {read_description("grove", grove_scene_json), make_grove};
}

}  // namespace ml
