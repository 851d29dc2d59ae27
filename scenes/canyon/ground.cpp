#include <algorithm>
#include <cmath>

#include "harness/base/random.h"
#include "harness/scene/noise.h"
#include "harness/scene/turn.h"
#include "scenes/canyon/parts.h"

namespace ml {
namespace {

// How far (x, z) lies outside the valley floor, m; negative on it.
double outside(double x, double z) {
  double across = std::abs(z - canyon_center(x)) - canyon_half_width(x);
  double along = std::abs(x) - 83;
  if (across <= 0 || along <= 0) return std::max(across, along);
  return std::sqrt(across * across + along * along);
}

double raw_height(uint32_t seed, double x, double z) {
  double beyond = outside(x, z) + 2.2 * rough(seed + 1, x / 9, z / 9) * smooth_step(-4, 4, outside(x, z));
  // Two steps with a ledge between, as weathered layers have.
  double wall = 15 * smooth_step(0, 5.5, beyond) + 11 * smooth_step(6.5, 12.5, beyond);
  double ground = 0.35 * rough(seed + 2, x / 12, z / 12) + 0.25 * smooth_step(-9, 0, beyond);
  double bed = z - canyon_center(x) - 7 * sine_of_turns(x / 85 + 0.1);
  ground -= 1.7 * smooth_step(3.2, 0, std::abs(bed)) * smooth_step(-3, -7, outside(x, z));
  double roughness = 1.3 * rough(seed + 3, x / 5, z / 5) * smooth_step(1, 9, beyond);
  double peaks = 12 * smooth_step(9, 34, beyond) * (0.55 + 0.6 * rough(seed + 4, x / 22, z / 22));
  // The ends of the valley are shut by the highest mountains, far enough away to be the long views'
  // background.
  double ends = 12 * smooth_step(82, 93, std::abs(x)) * (0.75 + 0.3 * rough(seed + 5, x / 9, z / 9));
  return ground + wall + roughness + peaks + ends;
}

// Level within 1.3 m around the footprint, then a steep slope: a cutting in the hillside.
double levelled(const std::vector<Footprint>& footprints, double x, double z, double height) {
  for (const Footprint& f : footprints) {
    double dx = std::max({f.min.x - x, x - f.max.x, 0.0}), dz = std::max({f.min.y - z, z - f.max.y, 0.0});
    double share = smooth_step(1.3, 3.9, std::sqrt(dx * dx + dz * dz));
    height = f.height + (height - f.height) * share;
  }
  return height;
}

}  // namespace

double canyon_center(double x) {
  double bend = 12 * smooth_step(40, 88, std::abs(x));
  return x < 0 ? -bend : bend;
}

double canyon_half_width(double x) {
  return 19.5 - 3.5 * cosine_of_turns(std::min(std::abs(x), 62.0) / 110);
}

CanyonGround::CanyonGround(uint32_t seed, const std::vector<Footprint>& footprints) {
  heights_.resize(static_cast<size_t>(kCellsX + 1) * (kCellsZ + 1));
  double lowest = 0, highest = 26;
  size_t next = 0;
  for (int k = 0; k <= kCellsZ; ++k) {
    for (int i = 0; i <= kCellsX; ++i) {
      double x = kMinX + i * kCell, z = kMinZ + k * kCell;
      double height = levelled(footprints, x, z, raw_height(hash_u32(seed), x, z));
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
      heights_[next++] = height;
    }
  }
  // What lies below 0 and above 26 m is stretched, so that the level is 40 m high for every seed.
  for (double& height : heights_) {
    if (height < 0) height *= kLowest / lowest;
    if (height > 26) height = 26 + (height - 26) * ((kHighest - 26) / (highest - 26));
    height = quantised(height);
  }
}

double CanyonGround::height(double x, double z) const {
  double gx = std::clamp((x - kMinX) / kCell, 0.0, kCellsX - 1e-9);
  double gz = std::clamp((z - kMinZ) / kCell, 0.0, kCellsZ - 1e-9);
  auto i = static_cast<int>(gx), k = static_cast<int>(gz);
  double u = gx - i, v = gz - k;
  double near = at(i, k) + u * (at(i + 1, k) - at(i, k));
  double far = at(i, k + 1) + u * (at(i + 1, k + 1) - at(i, k + 1));
  return near + v * (far - near);
}

void CanyonGround::build(MeshBuilder& mesh, const CanyonMaterials& materials) const {
  std::vector<uint32_t> vertices;
  vertices.reserve(heights_.size());
  for (int k = 0; k <= kCellsZ; ++k) {
    for (int i = 0; i <= kCellsX; ++i) {
      int left = std::max(i - 1, 0), right = std::min(i + 1, kCellsX);
      int back = std::max(k - 1, 0), front = std::min(k + 1, kCellsZ);
      double slope_x = (at(right, k) - at(left, k)) / (kCell * (right - left));
      double slope_z = (at(i, front) - at(i, back)) / (kCell * (front - back));
      vertices.push_back(
          mesh.vertex({kMinX + i * kCell, at(i, k), kMinZ + k * kCell}, {-slope_x, 1, -slope_z}));
    }
  }
  auto index = [&](int i, int k) { return vertices[static_cast<size_t>(k) * (kCellsX + 1) + i]; };
  for (int k = 0; k < kCellsZ; ++k) {
    for (int i = 0; i < kCellsX; ++i) {
      double heights[4] = {at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)};
      auto [low, high] = std::minmax_element(heights, heights + 4);
      uint32_t material = *high - *low < 0.7 && *high < 4 ? materials.sand : materials.rock;
      // Along the diagonal whose ends differ less: fewer teeth on steep walls.
      if (std::abs(at(i, k) - at(i + 1, k + 1)) <= std::abs(at(i + 1, k) - at(i, k + 1))) {
        mesh.smooth_triangle(index(i, k), index(i, k + 1), index(i + 1, k + 1), material);
        mesh.smooth_triangle(index(i, k), index(i + 1, k + 1), index(i + 1, k), material);
      } else {
        mesh.smooth_triangle(index(i, k), index(i, k + 1), index(i + 1, k), material);
        mesh.smooth_triangle(index(i + 1, k), index(i, k + 1), index(i + 1, k + 1), material);
      }
    }
  }
}

}  // namespace ml
