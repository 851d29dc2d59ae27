#include <algorithm>
#include <cmath>

#include "scenes/citadel/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);

// m; the ridge runs along local z, the door is on the +z side.
struct House {
  double width, depth, eaves, ridge;
  double cellar;  // how far the walls reach below local 0
};

void build_house(const TurnedMesh& mesh, const House& h, uint32_t walls, uint32_t roof) {
  double w = 0.5 * h.width, d = 0.5 * h.depth, foot = -h.cellar;
  for (double side : {-1.0, 1.0}) {
    // Turning a wall half-way round is negating x and z.
    auto at = [&](double x, double y, double z) { return glm::dvec3(side * x, y, side * z); };
    mesh.quad(at(w, foot, d), at(w, foot, -d), at(w, h.eaves, -d), at(w, h.eaves, d), walls);
    mesh.quad(at(-w, foot, d), at(w, foot, d), at(w, h.eaves, d), at(-w, h.eaves, d), walls);
    mesh.triangle(at(-w, h.eaves, d), at(w, h.eaves, d), at(0, h.ridge, d), walls);
  }
  // Two slabs that meet at the ridge; the faces in which they touch are left out.
  constexpr double kOver = 0.35, kThick = 0.2;
  double drop = (h.ridge - h.eaves) * (w + kOver) / w, low = h.ridge - drop;
  for (bool right : {false, true}) {
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < 8; ++i) {
      bool out = ((i & 1) != 0) == right;
      double x = out ? (right ? w + kOver : -w - kOver) : 0;
      double y = (out ? low : h.ridge) + (i & 2 ? kThick : 0);
      corners[i] = {x, y, i & 4 ? d + kOver : -d - kOver};
    }
    unsigned inner = right ? MeshBuilder::west : MeshBuilder::east;
    mesh.block(corners, roof, MeshBuilder::all & ~inner);
  }
}

void build_chimney(const TurnedMesh& mesh, const House& h, double z, uint32_t material) {
  double x = 0.2 * h.width;
  mesh.box({x - 0.35, h.eaves + 0.2, z - 0.35}, {x + 0.35, h.ridge + 0.9, z + 0.35}, material, kNoBottom);
}

// Where the ground under the house is lowest, relative to `origin`, and some more.
double cellar_of(const HeightField& ground, const TurnedMesh& mesh, const glm::dvec3& origin, double width,
                 double depth) {
  double lowest = origin.y;
  for (double x : {-0.5, 0.5}) {
    for (double z : {-0.5, 0.0, 0.5}) {
      glm::dvec3 corner = mesh.point(x * width, 0, z * depth);
      lowest = std::min(lowest, ground.height(corner.x, corner.z));
    }
  }
  return origin.y - lowest + 0.5;
}

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

void build_town_house(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground,
                      Random& random, double turns, double radius, bool faces_out) {
  radius += between(random, -0.3, 0.3);
  glm::dvec3 origin = citadel_point(turns, radius, 0), outward = citadel_point(turns, faces_out ? 1 : -1, 0);
  origin.y = ground.height(origin.x, origin.z);
  TurnedMesh turned(mesh, origin, {outward.x, outward.z});
  House h;
  h.width = between(random, 4.5, 5.1);
  h.depth = between(random, 5.9, 6.7);
  h.eaves = between(random, 3.8, 6.4);
  h.ridge = h.eaves + between(random, 2.0, 3.0);
  h.cellar = cellar_of(ground, turned, origin, h.width, h.depth);
  uint32_t walls = materials.plaster[random.below(3)], roof = materials.tiles[random.below(2)];
  build_house(turned, h, walls, roof);
  double chimney = between(random, -0.3, 0.3) * h.depth;
  build_chimney(turned, h, chimney, materials.stone);
  // The door stands on the street, higher or lower than the house's middle.
  double side = random.below(2) ? 0.9 : -0.9, front = 0.5 * h.depth;
  glm::dvec3 step = turned.point(side, 0, front + 0.1);
  double sill = ground.height(step.x, step.z) - origin.y;
  double top = std::min(sill + 2.2, h.eaves - 0.3);
  turned.box({side - 0.55, sill - 0.4, front}, {side + 0.55, top, front + 0.12}, materials.wood,
             kNoBottom & ~static_cast<unsigned>(MeshBuilder::north));
}

// Is a point of `points` within `margin` m of `position`, seen from above, and at most `height` m above it?
bool near_any(const std::vector<glm::dvec3>& points, const glm::dvec3& position, double margin,
              double height) {
  return std::any_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
    double dx = p.x - position.x, dz = p.z - position.z;
    return dx * dx + dz * dz < margin * margin && p.y < position.y + height;
  });
}

bool near_any(const std::vector<glm::dvec2>& points, const glm::dvec3& position, double margin) {
  return std::any_of(points.begin(), points.end(), [&](const glm::dvec2& p) {
    double dx = p.x - position.x, dz = p.y - position.z;
    return dx * dx + dz * dz < margin * margin;
  });
}

// A point outside the wall, off the road: uniform over the ring between the radii.
glm::dvec3 point_outside(const HeightField& ground, Random& random, double nearest, double farthest) {
  for (;;) {
    double turns = between(random, 0, 1), share = between(random, 0, 1);
    double radius = std::sqrt(nearest * nearest + share * (farthest * farthest - nearest * nearest));
    glm::dvec3 position = citadel_point(turns, radius, 0);
    if (position.z > 0 && std::abs(position.x) < 9) continue;
    position.y = ground.height(position.x, position.z);
    // Not in the wettest hollows, where foundations would lie below the level.
    if (position.y > -2.5) return position;
  }
}

void build_conifer(MeshBuilder& mesh, const CitadelMaterials& materials, const glm::dvec3& foot,
                   double height) {
  // The trunk ends in the lowest cone; its top needs no face of its own there, but costs two triangles.
  mesh.prism(foot - glm::dvec3(0, 0.6, 0), 0.22 * height + 0.6, 0.03 * height, 0.025 * height, 4,
             materials.wood);
  for (int tier = 0; tier < 2; ++tier) {
    double low = height * (tier == 0 ? 0.16 : 0.46), top = height * (tier == 0 ? 0.7 : 1.0);
    mesh.cone(foot + glm::dvec3(0, low, 0), top - low, height * (tier == 0 ? 0.21 : 0.15), 6,
              materials.needles);
  }
}

}  // namespace

int build_town(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground,
               Random& random) {
  constexpr double kPitch = 5.5, kStreet = 5, kTurn = 6.283185307179586;
  // Rows of houses back to back, their doors on the ring streets.
  struct Row {
    double radius;
    bool faces_out;
  };
  int houses = 0;
  for (Row row : {Row{36, true}, {50, false}, {58.5, true}, {72.5, false}, {81, true}, {94, false}}) {
    double sector = kTurn * row.radius / kStraightStreets;
    auto count = static_cast<int>((sector - kStreet) / kPitch);
    double pitch = (sector - kStreet) / count;
    for (int street = 0; street < kStraightStreets; ++street) {
      for (int i = 0; i < count; ++i) {
        double along = street * sector + 0.5 * kStreet + (i + 0.5) * pitch;
        build_town_house(mesh, materials, ground, random, along / (kTurn * row.radius), row.radius,
                         row.faces_out);
        ++houses;
      }
    }
  }
  return houses;
}

std::vector<glm::dvec2> build_farms(MeshBuilder& mesh, const CitadelMaterials& materials,
                                    const HeightField& ground, Random& random,
                                    const std::vector<glm::dvec3>& keep_clear) {
  constexpr size_t kFarms = 70;
  std::vector<glm::dvec2> farms;
  while (farms.size() < kFarms) {
    glm::dvec3 origin = point_outside(ground, random, 134, 330);
    double turns = between(random, 0, 1);
    if (near_any(farms, origin, 24) || near_any(keep_clear, origin, 16, 12)) continue;
    farms.emplace_back(origin.x, origin.z);
    glm::dvec3 ahead = citadel_point(turns, 1, 0);
    for (bool barn : {false, true}) {
      glm::dvec3 position = TurnedMesh(mesh, origin, {ahead.x, ahead.z}).point(barn ? 10.5 : 0, 0, 1.5);
      position.y = ground.height(position.x, position.z);
      // The barn stands across the house.
      TurnedMesh turned(mesh, position, barn ? glm::dvec2(ahead.z, -ahead.x) : glm::dvec2(ahead.x, ahead.z));
      House h;
      h.width = between(random, 6, 7.5);
      h.depth = between(random, 9, 12);
      h.eaves = between(random, 2.8, 4);
      h.ridge = h.eaves + between(random, 2.6, 3.6);
      h.cellar = cellar_of(ground, turned, position, h.width, h.depth);
      uint32_t walls = materials.plaster[random.below(3)], roof = materials.tiles[random.below(2)];
      build_house(turned, h, barn ? materials.wood : walls, roof);
      if (!barn) build_chimney(turned, h, 0.25 * h.depth, materials.stone);
    }
    glm::dvec3 rick = TurnedMesh(mesh, origin, {ahead.x, ahead.z}).point(-7, 0, 4);
    rick.y = ground.height(rick.x, rick.z) - 0.4;
    mesh.prism(rick, 3.2, 2.2, 0.4, 7, materials.earth);
  }
  return farms;
}

void build_conifers(MeshBuilder& mesh, const CitadelMaterials& materials, const HeightField& ground,
                    Random& random, const std::vector<glm::dvec3>& keep_clear,
                    const std::vector<glm::dvec2>& farms) {
  constexpr size_t kConifers = 500;
  std::vector<glm::dvec2> trees;
  std::vector<glm::dvec3> woods;
  // Half of them stand alone, half in some twenty woods.
  while (woods.size() < 20) woods.push_back(point_outside(ground, random, 150, 310));
  while (trees.size() < kConifers) {
    glm::dvec3 foot = point_outside(ground, random, 122, 330);
    double height = between(random, 7, 13);
    if (trees.size() % 2 == 0) {
      const glm::dvec3& wood = woods[random.below(20)];
      double x = wood.x + between(random, -22, 22), z = wood.z + between(random, -22, 22);
      double r = std::sqrt(x * x + z * z);
      foot = {x, ground.height(x, z), z};
      if (r < 122 || r > 330 || (z > 0 && std::abs(x) < 9) || foot.y < -2.5) continue;
    }
    if (near_any(farms, foot, 17) || near_any(trees, foot, 3.2) ||
        near_any(keep_clear, foot, 6, height + 4)) {
      continue;
    }
    trees.emplace_back(foot.x, foot.z);
    build_conifer(mesh, materials, foot, height);
  }
}

}  // namespace ml
