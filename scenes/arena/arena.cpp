#include "scenes/arena/arena.h"

#include "embedded/arena_scene_json.h"
#include "harness/scene/turned_mesh.h"
#include "scenes/arena/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);

ArenaMaterials add_materials(MeshBuilder& mesh) {
  const auto add = adder_of_materials(mesh);
  ArenaMaterials materials;
  materials.grass = add("grass", {0.23f, 0.34f, 0.13f}, 0, 0.95f);
  materials.earth = add("earth", {0.42f, 0.33f, 0.22f}, 0, 0.97f);
  materials.concrete = add("concrete", {0.5f, 0.5f, 0.48f}, 0, 0.85f);
  materials.plaster = add("plaster", {0.68f, 0.63f, 0.52f}, 0, 0.9f);
  materials.roof = add("roof", {0.4f, 0.18f, 0.12f}, 0, 0.6f);
  materials.metal = add("metal", {0.56f, 0.57f, 0.58f}, 1, 0.35f);
  materials.bark = add("bark", {0.27f, 0.19f, 0.12f}, 0, 0.9f);
  materials.wood[0] = add("dark wood", {0.32f, 0.21f, 0.12f}, 0, 0.7f);
  materials.wood[1] = add("light wood", {0.58f, 0.43f, 0.26f}, 0, 0.7f);
  materials.cloth[0] = add("white cloth", {0.72f, 0.7f, 0.64f}, 0, 0.95f, Finish::double_sided);
  materials.cloth[1] = add("blue cloth", {0.16f, 0.26f, 0.5f}, 0, 0.95f, Finish::double_sided);
  materials.cloth[2] = add("red cloth", {0.55f, 0.14f, 0.12f}, 0, 0.95f, Finish::double_sided);
  materials.leaves[0] = add("leaves", {0.15f, 0.32f, 0.09f}, 0, 0.8f);
  materials.leaves[1] = add("yellow leaves", {0.4f, 0.4f, 0.11f}, 0, 0.8f);
  return materials;
}

}  // namespace

void build_arena_ground(MeshBuilder& mesh, const ArenaMaterials& materials, Random& random) {
  constexpr int kTiles = 18;
  constexpr double kTile = 2 * kArenaHalf / kTiles;
  for (int k = 0; k < kTiles; ++k) {
    for (int i = 0; i < kTiles; ++i) {
      glm::dvec3 a(-kArenaHalf + i * kTile, 0, -kArenaHalf + k * kTile);
      mesh.quad(a, a + glm::dvec3(0, 0, kTile), a + glm::dvec3(kTile, 0, kTile), a + glm::dvec3(kTile, 0, 0),
                random.below(3) == 0 ? materials.earth : materials.grass);
    }
  }
  for (glm::dvec2 out : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    TurnedMesh side(mesh, glm::dvec3(0), out);
    side.box({-kArenaHalf, 0, kArenaHalf - kArenaWall}, {kArenaHalf - kArenaWall, 3, kArenaHalf},
             materials.concrete, kNoBottom);
  }
}

void build_arena_house(MeshBuilder& mesh, const ArenaMaterials& materials) {
  constexpr double kDoorHalf = 0.9, kDoorHeight = 2.4, kOut = kRoomHalf + kRoomWall;
  // Local z looks out of the door.
  TurnedMesh house(mesh, {kRoomX, 0, kRoomZ}, {-1, 0});
  house.box({-kOut, 0, kRoomHalf}, {-kDoorHalf, kRoomHeight, kOut}, materials.plaster, kNoBottom);
  house.box({kDoorHalf, 0, kRoomHalf}, {kOut, kRoomHeight, kOut}, materials.plaster, kNoBottom);
  house.box({-kDoorHalf, kDoorHeight, kRoomHalf}, {kDoorHalf, kRoomHeight, kOut}, materials.plaster);
  house.box({-kOut, 0, -kOut}, {kOut, kRoomHeight, -kRoomHalf}, materials.plaster, kNoBottom);
  for (double side : {-1.0, 1.0}) {
    double x0 = side < 0 ? -kOut : kRoomHalf, x1 = side < 0 ? -kRoomHalf : kOut;
    house.box({x0, 0, -kRoomHalf}, {x1, kRoomHeight, kRoomHalf}, materials.plaster, kNoBottom);
  }
  // Over the walls' outer faces, so that no crack shows the sky.
  house.box({-kOut - 0.3, kRoomHeight, -kOut - 0.3}, {kOut + 0.3, kRoomHeight + 0.4, kOut + 0.3},
            materials.roof);
  Random random(7);
  const auto object = [&](double x, double z) { return house.point(x, 0.02, z); };
  house.box({-kRoomHalf, 0, -kRoomHalf}, {kRoomHalf, 0.02, kRoomHalf}, materials.wood[1], MeshBuilder::top);
  for (double x : {-3.2, 3.2})
    mesh.prism(object(x, 0), kRoomHeight - 0.02, 0.3, 0.25, 10, materials.concrete);
  for (glm::dvec2 position : {glm::dvec2(-4.9, -4.8), {-3.4, -5}, {4.9, -4.6}, {4.8, 4.7}, {-5, 4.9}})
    build_crate(mesh, materials, random, object(position.x, position.y), {0.2, 1}, 1.1);
  house.box({-1.2, 0.7, -4.6}, {1.2, 0.8, -3.6}, materials.wood[0]);
  for (double x : {-1.1, 1.1})
    house.box({x - 0.05, 0.02, -4.5}, {x + 0.05, 0.7, -3.7}, materials.metal, kNoBottom);
}

namespace {

Scene make_arena(const SceneDescription& description, uint32_t seed) {
  MeshBuilder mesh;
  ArenaMaterials materials = add_materials(mesh);
  std::vector<CameraPath> paths = camera_paths(description);
  const std::vector<glm::dvec3> keep_clear = paths[0].positions(400);
  Random ground(hash_u32(seed, 51)), objects(hash_u32(seed, 52));
  build_arena_ground(mesh, materials, ground);
  build_arena_house(mesh, materials);
  build_arena_objects(mesh, materials, objects, keep_clear);

  Scene scene = finish_level(mesh, description, std::move(paths));
  scene.rooms = {{glm::vec3(kRoomX - kRoomHalf, 0, kRoomZ - kRoomHalf),
                  glm::vec3(kRoomX + kRoomHalf, kRoomHeight, kRoomZ + kRoomHalf)}};
  return scene;
}

}  // namespace

SceneEntry arena_scene() {
  return {read_description("arena", arena_scene_json), make_arena};
}

}  // namespace ml
