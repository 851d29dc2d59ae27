#include <algorithm>
#include <cmath>

#include "harness/scene/turn.h"
#include "scenes/grove/parts.h"

namespace ml {
namespace {

constexpr int kTrees = 520, kLeaves = 66;
constexpr double kHalf = 146;  // m, |x| and |z| of the outermost trees

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.uniform());
}

// Uniform in the unit ball.
glm::dvec3 in_ball(Random& random) {
  for (;;) {
    double x = between(random, -1, 1), y = between(random, -1, 1), z = between(random, -1, 1);
    glm::dvec3 p(x, y, z);
    double square = glm::dot(p, p);
    if (square <= 1 && square > 0.01) return p;
  }
}

// A leaf stands for a twig's leaves: one opaque triangle, seen from both sides.
void build_leaf(MeshBuilder& mesh, Random& random, const glm::dvec3& middle, double size, uint32_t material) {
  glm::dvec3 a = in_ball(random), b = in_ball(random);
  a /= std::sqrt(glm::dot(a, a));
  b -= glm::dot(a, b) * a;
  double length = std::sqrt(glm::dot(b, b));
  if (length < 0.05) {
    b = std::abs(a.y) < 0.9 ? glm::dvec3(-a.z, 0, a.x) : glm::dvec3(0, -a.z, a.y);
    length = std::sqrt(glm::dot(b, b));
  }
  b /= length;
  mesh.triangle(middle + size * a, middle + size * (-0.5 * a + 0.75 * b),
                middle + size * (-0.5 * a - 0.75 * b), material);
}

void build_tree(MeshBuilder& mesh, const GroveMaterials& materials, Random& random, const glm::dvec3& foot) {
  double height = between(random, 4.5, 8.5), radius = between(random, 1.5, 2.4);
  // Some carry their leaves down to the ground.
  double clear = random.below(3) == 0 ? 0.3 : between(random, 1.1, 2.0);
  uint32_t material = materials.leaves[random.below(3)];
  double trunk = 0.75 * height;
  mesh.prism(foot - glm::dvec3(0, 0.4, 0), trunk + 0.4, 0.032 * height, 0.012 * height, 5, materials.bark);
  glm::dvec3 middle = foot + glm::dvec3(0, 0.5 * (clear + height), 0);
  glm::dvec3 extent(radius, 0.5 * (height - clear), radius);
  for (int i = 0; i < kLeaves; ++i) {
    glm::dvec3 p = in_ball(random);
    // Thinner inside: leaves hang where light is.
    p *= std::sqrt(std::sqrt(1 / glm::dot(p, p)));
    double size = between(random, 0.35, 0.57);
    glm::dvec3 at = middle + p * extent;
    at.y = std::max(at.y, foot.y + 0.25);
    build_leaf(mesh, random, at, size, material);
  }
}

}  // namespace

void build_trees(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                 const GroveWay& way, Random& random, const std::vector<glm::dvec3>& keep_clear) {
  std::vector<glm::dvec2> trees;
  while (trees.size() < kTrees) {
    double x = between(random, -kHalf, kHalf), z = between(random, -kHalf, kHalf);
    glm::dvec2 position(x, z);
    // Every eighth one within 25 m of the way.
    if (trees.size() % 8 == 0) {
      double across = between(random, -25, 25);
      position = way.at(between(random, 0, way.length())).beside(across);
    }
    if (way.distance(position) < 4.2) continue;
    bool crowded = std::any_of(trees.begin(), trees.end(), [&](const glm::dvec2& other) {
      return glm::dot(other - position, other - position) < 2.6 * 2.6;
    });
    bool in_the_way = std::any_of(keep_clear.begin(), keep_clear.end(), [&](const glm::dvec3& point) {
      double dx = point.x - position.x, dz = point.z - position.y;
      return dx * dx + dz * dz < 4.2 * 4.2;
    });
    if (crowded || in_the_way) continue;
    trees.push_back(position);
    build_tree(mesh, materials, random, {position.x, ground.height(position.x, position.y), position.y});
  }
}

}  // namespace ml
