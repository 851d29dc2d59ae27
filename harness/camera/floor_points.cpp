#include "harness/camera/floor_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/random.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr double kColumns = 1600;
constexpr int kFloorsPerColumn = 8;
constexpr int kDirections = 16;
constexpr size_t kEnough = 24;     // points of a kind; fewer are taken for none
constexpr double kFlat = 0.7;      // vertical part of a floor's normal
constexpr double kLongView = 100;  // m

struct Candidate {
  FloorPoint point;
  bool roof = false;        // open sky above and another floor below
  double enclosure = 0;     // share of level views that end at something
  int front = 0, back = 0;  // sides of triangles that are seen
};

// Is there floor under most of the four points around?
bool room_to_stand(const RayCaster& rays, const glm::dvec3& eye, const Stature& stature) {
  int found = 0;
  for (int i = 0; i < 4; ++i) {
    double side = 0.7 * stature.scale;
    glm::dvec3 offset(i == 0 ? side : i == 1 ? -side : 0, 0, i == 2 ? side : i == 3 ? -side : 0);
    if (rays.nearest(eye + offset, {0, -1, 0}, stature.eye() + stature.scale)) ++found;
  }
  return found >= 3;
}

// Looks around from the eye. False when a wall is too near.
bool look_around(const RayCaster& rays, const Stature& stature, Candidate& candidate) {
  double sum = 0;
  int hits = 0;
  for (int i = 0; i < kDirections; ++i) {
    double turns = (i + 0.5) / kDirections;
    auto hit = rays.nearest(candidate.point.eye, {cosine_of_turns(turns), 0, sine_of_turns(turns)});
    if (hit) {
      if (hit->distance < stature.clearance()) return false;
      ++hits;
      ++(hit->front ? candidate.front : candidate.back);
    }
    sum += hit ? std::min(hit->distance, kLongView) : kLongView;
  }
  candidate.point.openness = sum / kDirections;
  candidate.enclosure = static_cast<double>(hits) / kDirections;
  return true;
}

void search_column(const RayCaster& rays, double x, double z, double top, const Stature& stature,
                   std::vector<Candidate>& found) {
  size_t first = found.size();
  glm::dvec3 from(x, top, z);
  for (int i = 0; i < kFloorsPerColumn; ++i) {
    auto hit = rays.nearest(from, {0, -1, 0});
    if (!hit) break;
    glm::dvec3 floor = from - glm::dvec3(0, hit->distance, 0);
    // On past this surface; the step grows with the coordinate so that it is never lost in rounding.
    from.y = floor.y - 1e-4 * stature.scale - 1e-9 * std::abs(floor.y);
    if (std::abs(rays.normal(hit->triangle).y) < kFlat) continue;
    Candidate candidate;
    candidate.point.eye = floor + glm::dvec3(0, stature.eye(), 0);
    (hit->front ? candidate.front : candidate.back) += 1;
    glm::dvec3 sole = floor + glm::dvec3(0, 0.05 * stature.scale, 0);
    auto above = rays.nearest(sole, {0, 1, 0});
    if (above && above->distance < stature.eye() + stature.headroom()) continue;
    if (above) ++(above->front ? candidate.front : candidate.back);
    candidate.roof = !above;
    if (!room_to_stand(rays, candidate.point.eye, stature) || !look_around(rays, stature, candidate))
      continue;
    found.push_back(candidate);
  }
  // What lies under open sky is a roof only if somebody can stand below it.
  for (size_t i = first; i < found.size(); ++i) found[i].roof = found[i].roof && i + 1 < found.size();
}

// Within a solid, or in the void under a level, one sees the wrong side of the triangles. The
// counter-clockwise side should be the right one; a file in which hardly any point sees that side is taken to
// be wound the other way round, and where neither holds nothing is dropped.
void drop_inside_solids(std::vector<Candidate>& candidates) {
  auto sees_front = [](const Candidate& c) { return c.back * 5 <= c.front + c.back; };
  auto sees_back = [](const Candidate& c) { return c.front * 5 <= c.front + c.back; };
  auto fronts = static_cast<size_t>(std::count_if(candidates.begin(), candidates.end(), sees_front));
  auto backs = static_cast<size_t>(std::count_if(candidates.begin(), candidates.end(), sees_back));
  if (fronts >= kEnough || fronts * 4 >= candidates.size()) {
    std::erase_if(candidates, [&](const Candidate& c) { return !sees_front(c); });
  } else if (backs >= kEnough) {
    std::erase_if(candidates, [&](const Candidate& c) { return !sees_back(c); });
  }
}

}  // namespace

std::vector<FloorPoint> find_floor_points(const RayCaster& rays, const Bounds& bounds, uint32_t seed,
                                          const Stature& stature, FloorKind kind) {
  glm::dvec3 low(bounds.min), size(glm::dvec3(bounds.max) - low);
  if (!(size.x > 0) || !(size.z > 0)) return {};
  double cell = std::sqrt(size.x * size.z / kColumns);
  auto columns = static_cast<uint32_t>(std::clamp(size.x / cell, 4.0, 400.0));
  auto rows = static_cast<uint32_t>(std::clamp(size.z / cell, 4.0, 400.0));
  std::vector<Candidate> candidates;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      uint32_t number = row * columns + column;
      double u = static_cast<double>(unit_float(hash_u32(seed, number, 0u)));
      double v = static_cast<double>(unit_float(hash_u32(seed, number, 1u)));
      search_column(rays, low.x + size.x * (column + u) / columns, low.z + size.z * (row + v) / rows,
                    low.y + size.y * 1.01 + 1, stature, candidates);
    }
  }
  drop_inside_solids(candidates);

  auto walled = [](const Candidate& c) { return !c.roof && c.enclosure >= 0.5; };
  auto ground = [](const Candidate& c) { return !c.roof; };
  std::vector<FloorPoint> points;
  if (kind == FloorKind::walled) {
    for (const Candidate& c : candidates) {
      if (walled(c)) points.push_back(c.point);
    }
    if (points.size() < kEnough) points.clear();
    return points;
  }
  bool has_ground = std::any_of(candidates.begin(), candidates.end(), ground);
  for (const Candidate& c : candidates) {
    if (!has_ground || ground(c)) points.push_back(c.point);
  }
  return points;
}

}  // namespace ml
