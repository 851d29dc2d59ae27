#include "harness/scene/ray_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "harness/base/check.h"

namespace ml {
namespace {

constexpr uint32_t kLeafSize = 4;
constexpr int kBins = 12;
// Below this depth nodes are halved by number, so that the traversal stack below is always deep enough.
constexpr int kSurfaceAreaDepth = 40;
constexpr size_t kStackSize = 128;

struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
  }
  double half_area() const {
    glm::dvec3 s = max - min;
    return s.x < 0 ? 0 : s.x * s.y + s.y * s.z + s.z * s.x;
  }
};

// Where the ray enters the box, or infinity if it misses it or enters beyond `limit`. The comparisons keep a
// NaN (0 * infinity: the ray runs in a side's plane) from ruling the box out.
double entry(const glm::dvec3& min, const glm::dvec3& max, const glm::dvec3& origin,
             const glm::dvec3& inverse, double limit) {
  double begin = 0, end = limit;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (min[axis] - origin[axis]) * inverse[axis];
    double b = (max[axis] - origin[axis]) * inverse[axis];
    if (a > b) std::swap(a, b);
    // Rounding may move the ends by an ulp or two; a factor (which leaves infinities alone) gives more than
    // that back.
    a *= a > 0 ? 1 - 1e-15 : 1 + 1e-15;
    b *= b > 0 ? 1 + 1e-15 : 1 - 1e-15;
    if (a > begin) begin = a;
    if (b < end) end = b;
  }
  return begin <= end ? begin : std::numeric_limits<double>::infinity();
}

}  // namespace

RayCaster::RayCaster(const Scene& scene) {
  size_t count = scene.indices.size() / 3;
  triangles_.reserve(count);
  std::vector<glm::dvec3> centers;
  centers.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    glm::dvec3 a(scene.vertices[scene.indices[3 * i]].position);
    glm::dvec3 b(scene.vertices[scene.indices[3 * i + 1]].position);
    glm::dvec3 c(scene.vertices[scene.indices[3 * i + 2]].position);
    triangles_.push_back({a, b - a, c - a});
    centers.push_back((a + b + c) / 3.0);
  }
  build(centers);
}

void RayCaster::bound(Node& node) const {
  Box box;
  for (uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Triangle& t = triangles_[order_[i]];
    box.add(t.corner);
    box.add(t.corner + t.edge1);
    box.add(t.corner + t.edge2);
  }
  node.min = box.min;
  node.max = box.max;
}

// Binned surface-area heuristic along the longest side of the centres' box.
void RayCaster::build(std::span<const glm::dvec3> centers) {
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (order_.empty()) return;
  nodes_.reserve(triangles_.size());
  nodes_.push_back({{}, {}, 0, static_cast<uint32_t>(order_.size())});
  bound(nodes_[0]);

  struct Task {
    uint32_t node;
    int depth;
  };
  std::vector<Task> tasks{{0, 0}};
  while (!tasks.empty()) {
    auto [index, depth] = tasks.back();
    tasks.pop_back();
    uint32_t first = nodes_[index].first, count = nodes_[index].count;
    if (count <= kLeafSize) continue;

    Box middle;
    for (uint32_t i = first; i < first + count; ++i) middle.add(centers[order_[i]]);
    glm::dvec3 size = middle.max - middle.min;
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    auto begin = order_.begin() + first, end = begin + count;
    auto split = begin;
    if (size[axis] > 0 && depth < kSurfaceAreaDepth) {
      auto bin_of = [&](uint32_t t) {
        return std::min(static_cast<int>((centers[t][axis] - middle.min[axis]) / size[axis] * kBins),
                        kBins - 1);
      };
      std::array<Box, kBins> boxes;
      std::array<uint32_t, kBins> counts{};
      for (auto it = begin; it != end; ++it) {
        const Triangle& t = triangles_[*it];
        int bin = bin_of(*it);
        boxes[bin].add(t.corner);
        boxes[bin].add(t.corner + t.edge1);
        boxes[bin].add(t.corner + t.edge2);
        ++counts[bin];
      }
      std::array<double, kBins> right_cost{};
      Box right;
      uint32_t right_count = 0;
      for (int bin = kBins - 1; bin > 0; --bin) {
        right.add(boxes[bin]);
        right_count += counts[bin];
        right_cost[bin] = right.half_area() * right_count;
      }
      Box left;
      uint32_t left_count = 0;
      double best = std::numeric_limits<double>::infinity();
      int best_bin = 1;
      for (int bin = 1; bin < kBins; ++bin) {
        left.add(boxes[bin - 1]);
        left_count += counts[bin - 1];
        double cost = left.half_area() * left_count + right_cost[bin];
        if (cost < best && left_count > 0 && left_count < count) {
          best = cost;
          best_bin = bin;
        }
      }
      split = std::stable_partition(begin, end, [&](uint32_t t) { return bin_of(t) < best_bin; });
    }
    if (split == begin || split == end) split = begin + count / 2;

    auto left_size = static_cast<uint32_t>(split - begin);
    auto child = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({{}, {}, first, left_size});
    nodes_.push_back({{}, {}, first + left_size, count - left_size});
    bound(nodes_[child]);
    bound(nodes_[child + 1]);
    nodes_[index].first = child;
    nodes_[index].count = 0;
    tasks.push_back({child, depth + 1});
    tasks.push_back({child + 1, depth + 1});
  }
}

std::optional<RayHit> RayCaster::nearest(const glm::dvec3& origin, const glm::dvec3& direction,
                                         double limit) const {
  if (nodes_.empty()) return std::nullopt;
  glm::dvec3 inverse = 1.0 / direction;
  std::optional<RayHit> best;
  struct Entry {
    uint32_t node;
    double distance;
  };
  std::array<Entry, kStackSize> stack;
  size_t top = 0;
  double root = entry(nodes_[0].min, nodes_[0].max, origin, inverse, limit);
  if (root < std::numeric_limits<double>::infinity()) stack[top++] = {0, root};
  while (top > 0) {
    auto [index, distance] = stack[--top];
    if (distance > limit) continue;
    const Node& node = nodes_[index];
    if (node.count == 0) {
      std::array<Entry, 2> children;
      for (uint32_t side = 0; side < 2; ++side) {
        const Node& child = nodes_[node.first + side];
        children[side] = {node.first + side, entry(child.min, child.max, origin, inverse, limit)};
      }
      if (children[0].distance < children[1].distance) std::swap(children[0], children[1]);
      ML_DCHECK_LE(top + 2, kStackSize);
      for (const Entry& child : children) {
        if (child.distance < std::numeric_limits<double>::infinity()) stack[top++] = child;
      }
      continue;
    }
    // Moller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[order_[i]];
      glm::dvec3 p = glm::cross(direction, t.edge2);
      double determinant = glm::dot(t.edge1, p);
      if (determinant == 0) continue;
      glm::dvec3 s = origin - t.corner;
      double u = glm::dot(s, p) / determinant;
      if (!(u >= 0 && u <= 1)) continue;
      glm::dvec3 q = glm::cross(s, t.edge1);
      double v = glm::dot(direction, q) / determinant;
      if (!(v >= 0 && u + v <= 1)) continue;
      double hit = glm::dot(t.edge2, q) / determinant;
      bool nearer = hit > 0 && (hit < limit || (best && hit == limit && order_[i] < best->triangle));
      if (!nearer) continue;
      limit = hit;
      best = RayHit{hit, order_[i], determinant > 0};
    }
  }
  return best;
}

glm::dvec3 RayCaster::normal(uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  return glm::normalize(glm::cross(t.edge1, t.edge2));
}

}  // namespace ml
