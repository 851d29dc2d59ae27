#include "scenes/museum/museum.h"

#include "embedded/museum_scene_json.h"
#include "scenes/museum/parts.h"

namespace ml {
namespace {

// Metals and glazes are lit forward: they are what would want a lighting model of its own.
MuseumMaterials add_materials(MeshBuilder& mesh) {
  const auto add = adder_of_materials(mesh);
  MuseumMaterials materials;
  materials.marble = add("marble", {0.74f, 0.72f, 0.68f}, 0, 0.3f);
  materials.slate = add("slate", {0.2f, 0.2f, 0.22f}, 0, 0.35f);
  materials.ceiling = add("ceiling", {0.8f, 0.79f, 0.76f}, 0, 0.95f);
  materials.beam = add("beam", {0.33f, 0.22f, 0.13f}, 0, 0.7f);
  materials.trim = add("trim", {0.78f, 0.75f, 0.68f}, 0, 0.8f);
  materials.stone = add("stone", {0.56f, 0.53f, 0.48f}, 0, 0.7f);
  materials.gilt = add("gilt", {0.83f, 0.64f, 0.29f}, 1, 0.3f, Finish::forward);
  materials.bronze = add("bronze", {0.51f, 0.36f, 0.22f}, 1, 0.4f, Finish::forward);
  materials.wood = add("wood", {0.25f, 0.15f, 0.09f}, 0, 0.55f);
  materials.paint[0] = add("white paint", {0.77f, 0.75f, 0.71f}, 0, 0.9f);
  materials.paint[1] = add("green paint", {0.3f, 0.42f, 0.34f}, 0, 0.9f);
  materials.paint[2] = add("red paint", {0.5f, 0.22f, 0.19f}, 0, 0.9f);
  materials.paint[3] = add("blue paint", {0.26f, 0.34f, 0.48f}, 0, 0.9f);
  materials.canvas[0] = add("canvas 0", {0.62f, 0.5f, 0.3f}, 0, 0.6f);
  materials.canvas[1] = add("canvas 1", {0.2f, 0.28f, 0.4f}, 0, 0.6f);
  materials.canvas[2] = add("canvas 2", {0.45f, 0.16f, 0.12f}, 0, 0.6f);
  materials.canvas[3] = add("canvas 3", {0.24f, 0.34f, 0.18f}, 0, 0.6f);
  materials.canvas[4] = add("canvas 4", {0.7f, 0.66f, 0.58f}, 0, 0.6f);
  materials.canvas[5] = add("canvas 5", {0.12f, 0.1f, 0.1f}, 0, 0.6f);
  materials.glaze[0] = add("white glaze", {0.8f, 0.82f, 0.84f}, 0, 0.15f, Finish::forward);
  materials.glaze[1] = add("blue glaze", {0.1f, 0.2f, 0.5f}, 0, 0.15f, Finish::forward);
  materials.glaze[2] = add("red glaze", {0.5f, 0.1f, 0.08f}, 0, 0.2f, Finish::forward);
  return materials;
}

Scene make_museum(const SceneDescription& description, uint32_t seed) {
  MeshBuilder mesh;
  MuseumMaterials materials = add_materials(mesh);
  Random walls(hash_u32(seed, 31)), exhibits(hash_u32(seed, 32));
  build_museum_rooms(mesh, materials, walls);
  build_museum_columns(mesh, materials);
  build_museum_exhibits(mesh, materials, exhibits);

  Scene scene = finish_level(mesh, description, camera_paths(description));
  for (int k = 0; k < kMuseumRoomsZ; ++k) {
    for (int i = 0; i < kMuseumRoomsX; ++i) {
      const double half = 0.5 * (kMuseumPitch - kMuseumWall);
      glm::dvec3 middle = museum_room(i, k);
      scene.rooms.push_back({glm::vec3(middle - glm::dvec3(half, 0, half)),
                             glm::vec3(middle + glm::dvec3(half, kMuseumHeight, half))});
    }
  }
  return scene;
}

}  // namespace

SceneEntry museum_scene() {
  return {read_description("museum", museum_scene_json), make_museum};
}

}  // namespace ml
