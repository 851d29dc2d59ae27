#include "scenes/canyon/parts.h"
#include "scenes/procedural.h"

namespace ml {
namespace {

CameraPath make_path(const CanyonGround& ground) {
  Fort west = canyon_fort(-1), east = canyon_fort(1);
  auto above = [&](double x, double z, double eye) { return glm::dvec3(x, ground.height(x, z) + eye, z); };
  double north = kNorthTunnel.z, mouth = kNorthTunnel.x0;
  CameraPath path;
  path.name = "default";
  path.keys = {
      // The western roof, along the valley to the eastern fort.
      {0, west.point(0, 11.8, 0), {70, 24, 12}},
      {1.5, west.point(4, 11.9, 0), {70, 20, 12}},
      // Over the curtain wall, down to the ground, to the tunnel's mouth.
      {3, west.point(13, 9.6, 1.5), {-10, 2, -4}},
      {4.5, above(-46, -5, 3), {-28, 2, -14}},
      {6.5, above(-44, -9.5, 1.8), {mouth, 2.4, north - 3}},
      {8.5, {mouth - 5, 1.9, north + 0.6}, {mouth + 10, 2.2, north - 1}},
      {10, {mouth + 3, 1.9, north}, {mouth + 16, 2, north}},
      {12.5, {mouth + 22, 1.9, north}, {mouth + 37, 2, north - 0.5}},
      {15, {mouth + 43, 1.9, north}, {mouth + 58, 3, north + 3}},
      // Out, up and onto the bridge, along its railing.
      {16.6, {mouth + 53, 3.6, north + 2}, {kBridgeX + 4, 9, 0}},
      {18.2, {kBridgeX - 4, 11, -9}, {kBridgeX + 2, 11, 6}},
      {19.4, {kBridgeX, kBridgeDeck + 2.1, -4}, {kBridgeX + 1, kBridgeDeck + 1.2, 10}},
      {20.8, {kBridgeX + 0.5, kBridgeDeck + 2.3, 4}, {kBridgeX + 6, kBridgeDeck, 16}},
      {21.5, {kBridgeX + 4, kBridgeDeck + 2, 6.5}, {kBridgeX + 14, kBridgeDeck - 3, 17}},
      // Down to the eastern fort, through its gate and its keep.
      {22.2, {kBridgeX + 9, 9, 8.5}, {52, 4, 11}},
      {23.7, east.point(19, 2.6, -1), east.point(0, 2.2, 0.5)},
      {25, east.point(6, 1.9, 0), east.point(-6, 2.2, 2.5)},
      {26, east.point(0, 1.9, 0), east.point(-6.5, 2.6, 5)},
      {27.2, east.point(-9.7, 2.3, 0), east.point(-12, 9, 14)},
      // Up the wall to the rim; at 30 s the longest view of the level.
      {28.2, {81, 14, 21}, {70, 22, 36}},
      {29.2, {85.5, 30, 27}, {20, 24, 22}},
      {30, above(89.5, 28, 3), {-85, 27, 0}},
      {31, above(89, 27, 3.6), {-85, 25, -4}},
      // Back above the valley.
      {32, {82, 32, 25}, {-75, 20, -8}},
      {34.4, {48, 25, 17}, {-60, 8, -12}},
      {37, {0, 17, 2}, {-68, 7, -12}},
      {40, {-36, 12, -6}, {-68, 6, -12}},
  };
  return path;
}

}  // namespace

Scene make_canyon(uint32_t seed) {
  MeshBuilder mesh;
  CanyonMaterials materials;
  const auto add = adder_of_materials(mesh);
  materials.rock = add("rock", {0.36f, 0.28f, 0.22f}, 0, 0.9f);
  materials.sand = add("sand", {0.58f, 0.47f, 0.32f}, 0, 0.97f);
  materials.concrete = add("concrete", {0.5f, 0.5f, 0.48f}, 0, 0.7f);
  materials.metal = add("metal", {0.6f, 0.58f, 0.55f}, 1, 0.35f);
  materials.wood = add("wood", {0.42f, 0.26f, 0.13f}, 0, 0.55f);

  CanyonGround ground(seed, canyon_footprints());
  CameraPath path = make_path(ground);
  const std::vector<glm::dvec3> keep_clear = path.places(400);

  ground.build(mesh, materials);
  for (double side : {-1.0, 1.0}) build_fort(mesh, materials, canyon_fort(side));
  for (const Tunnel& tunnel : {kNorthTunnel, kSouthTunnel}) build_tunnel(mesh, materials, tunnel);
  build_bridge(mesh, materials);
  build_rocks(mesh, materials, ground, seed, keep_clear);

  return mesh.finish_level("canyon", kCanyonLights, 220, {path});
}

}  // namespace ml
