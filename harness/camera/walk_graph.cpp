#include "harness/camera/walk_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace ml {
namespace {

constexpr size_t kNeighbours = 10;

}  // namespace

bool walkable(const RayCaster& rays, const glm::dvec3& a, const glm::dvec3& b, const Stature& stature) {
  glm::dvec3 step = b - a;
  double level = std::sqrt(step.x * step.x + step.z * step.z);
  if (!(level > 0) || std::abs(step.y) > level) return false;
  glm::dvec3 waist(0, -0.7 * stature.scale, 0);
  glm::dvec3 side = glm::dvec3(-step.z, 0, step.x) * (0.4 * stature.scale / level);
  for (const glm::dvec3& offset : {glm::dvec3(0), waist, side, -side}) {
    if (!rays.clear(a + offset, b + offset)) return false;
  }
  return true;
}

WalkGraph::WalkGraph(const RayCaster& rays, const std::vector<FloorPoint>& points, const Stature& stature)
    : edges_(points.size()) {
  auto count = static_cast<uint32_t>(points.size());
  std::vector<std::pair<double, uint32_t>> near;
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t i = 0; i < count; ++i) {
    near.clear();
    for (uint32_t k = 0; k < count; ++k) {
      if (k == i) continue;
      glm::dvec3 step = points[k].eye - points[i].eye;
      step.y *= 2;
      near.emplace_back(glm::dot(step, step), k);
    }
    size_t wanted = std::min(kNeighbours, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(wanted), near.end());
    for (size_t n = 0; n < wanted; ++n)
      pairs.emplace_back(std::min(i, near[n].second), std::max(i, near[n].second));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (auto [a, b] : pairs) {
    if (!walkable(rays, points[a].eye, points[b].eye, stature)) continue;
    double length = glm::length(points[b].eye - points[a].eye);
    edges_[a].push_back({b, length});
    edges_[b].push_back({a, length});
  }

  std::vector<bool> seen(count, false);
  for (uint32_t start = 0; start < count; ++start) {
    if (seen[start]) continue;
    std::vector<uint32_t> part{start};
    seen[start] = true;
    for (size_t i = 0; i < part.size(); ++i) {
      for (const Edge& edge : edges_[part[i]]) {
        if (!seen[edge.to]) part.push_back(edge.to);
        seen[edge.to] = true;
      }
    }
    if (part.size() > largest_.size()) largest_ = std::move(part);
  }
  std::sort(largest_.begin(), largest_.end());
}

std::vector<double> WalkGraph::distances(uint32_t from, std::vector<uint32_t>& previous) const {
  std::vector<double> best(edges_.size(), std::numeric_limits<double>::infinity());
  previous.assign(edges_.size(), from);
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  best[from] = 0;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    auto [distance, point] = queue.top();
    queue.pop();
    if (distance > best[point]) continue;
    for (const Edge& edge : edges_[point]) {
      double length = distance + edge.length;
      if (length >= best[edge.to]) continue;
      best[edge.to] = length;
      previous[edge.to] = point;
      queue.emplace(length, edge.to);
    }
  }
  return best;
}

std::vector<uint32_t> WalkGraph::way(uint32_t from, uint32_t to) const {
  std::vector<uint32_t> previous;
  distances(from, previous);
  std::vector<uint32_t> points{to};
  while (points.back() != from) points.push_back(previous[points.back()]);
  std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace ml
