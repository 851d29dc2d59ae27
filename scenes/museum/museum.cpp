#include <algorithm>
#include <cmath>

#include "scenes/museum/parts.h"
#include "scenes/procedural.h"

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

}  // namespace

CameraPath make_museum_path() {
  struct Room {
    int i, k;
  };
  static constexpr Room tour[]{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {3, 1}, {3, 0}, {4, 0},
                               {4, 1}, {4, 2}, {3, 2}, {2, 2}, {2, 1}, {1, 1}};
  constexpr size_t kRooms = std::size(tour);
  // Middles and doorways in turn.
  std::vector<glm::dvec3> places;
  auto middle = [&](size_t n) { return museum_room(tour[n].i, tour[n].k); };
  for (size_t n = 0; n < kRooms; ++n) {
    glm::dvec3 from = middle(n > 0 ? n - 1 : 0), here = middle(n), to = middle(std::min(n + 1, kRooms - 1));
    glm::dvec3 in = (here - from) / kMuseumPitch, out = (to - here) / kMuseumPitch;
    // A turn is cut short; the ends are a little before and behind the middle.
    places.push_back(here + 0.8 * (out - in) * (n == 0 || n + 1 == kRooms ? -3.0 : 1.0));
    if (n + 1 < kRooms) places.push_back(0.5 * (here + to));
  }
  CameraPath path;
  path.name = "default";
  const size_t last = places.size() - 1;
  constexpr double kDuration = 60;
  for (size_t n = 0; n <= last; ++n) {
    double time = kDuration * static_cast<double>(n) / static_cast<double>(last);
    // Slowly up and down, and the look to one side and the other.
    glm::dvec3 eye = places[n] + glm::dvec3(0, n % 6 < 3 ? 1.7 : 2.1, 0);
    size_t ahead = std::min(n + 2, last);
    glm::dvec3 target = places[ahead] + glm::dvec3(0, n % 4 < 2 ? 2.0 : 2.6, 0);
    if (n + 2 > last)
      target = places[last] +
               6.0 * static_cast<double>(n + 2 - last) * (places[last] - places[last - 1]) / kMuseumPitch +
               glm::dvec3(0, 2.2, 0);
    path.keys.push_back({time, eye, target});
  }
  return path;
}

Scene make_museum(uint32_t seed) {
  MeshBuilder mesh;
  MuseumMaterials materials = add_materials(mesh);
  Random walls(hash_u32(seed, 31)), exhibits(hash_u32(seed, 32));
  build_museum_rooms(mesh, materials, walls);
  build_museum_columns(mesh, materials);
  build_museum_exhibits(mesh, materials, exhibits);

  Scene scene = mesh.finish_level("museum", kMuseumLights, 80, {make_museum_path()});
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

}  // namespace ml
