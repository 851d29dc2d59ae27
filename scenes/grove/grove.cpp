#include "harness/scene/noise.h"
#include "scenes/grove/parts.h"
#include "scenes/procedural.h"

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

CameraPath make_grove_path(const HeightField& ground, const GroveWay& way) {
  CameraPath path;
  path.name = "default";
  auto above = [&](const glm::dvec2& place, double eye) {
    return glm::dvec3(place.x, ground.height(place.x, place.y) + eye, place.y);
  };
  auto along = [&](double length, double across, double eye) {
    return above(way.at(length).beside(across), eye);
  };
  // Along the way, from one fence towards the other; then over the right-hand one.
  double time = 0, length = 6;
  for (int i = 0; i <= 11; ++i, time += 2, length += 13) {
    double sway = i % 4 < 2 ? 0.7 : -0.7;
    path.keys.push_back({time, along(length, sway, 1.35), along(length + 11, -1.6 * sway, 1.2)});
  }
  path.keys.push_back({24, along(154, 0.4, 2.1), along(163, 2, 1.6)});
  path.keys.push_back({26, along(162, 4.2, 2.6), along(171, 1, 1)});
  // Beside the way among the trees, looking across both fences.
  path.keys.push_back({28, along(170, 6.2, 1.8), along(179, -4, 1)});
  path.keys.push_back({31, along(181, 6.4, 1.5), along(190, -5, 1)});
  path.keys.push_back({34, along(192, 6.2, 1.6), along(202, -4, 1)});
  path.keys.push_back({36, along(201, 4, 2.8), along(213, -1, 1)});
  // Back over the way, high enough to look along both fences.
  path.keys.push_back({38, along(210, 0.5, 4), along(224, 0, 1)});
  path.keys.push_back({40, along(219, 0, 4.5), along(235, 0, 1.5)});
  return path;
}

Scene make_grove(uint32_t seed) {
  MeshBuilder mesh;
  GroveMaterials materials = add_materials(mesh);
  HeightField ground = make_grove_ground(seed);
  GroveWay way;
  CameraPath path = make_grove_path(ground, way);
  const std::vector<glm::dvec3> keep_clear = path.places(400);

  build_ground(mesh, materials, ground, way);
  build_fences(mesh, materials, ground, way);
  build_lamps(mesh, materials, ground, way);
  Random woods(hash_u32(seed, 21));
  build_trees(mesh, materials, ground, way, woods, keep_clear);

  return mesh.finish_level("grove", kGroveLights, 350, {path});
}

}  // namespace ml
