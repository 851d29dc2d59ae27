#include "harness/camera/automatic_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "harness/base/random.h"
#include "harness/camera/floor_points.h"
#include "harness/camera/orbit_path.h"
#include "harness/camera/view_probe.h"
#include "harness/camera/walk_graph.h"
#include "harness/scene/ray_caster.h"
#include "harness/scene/scene.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr size_t kMaxPoints = 400;
constexpr size_t kMinKeys = 10, kMaxCorners = 14, kMaxKeys = 32;
constexpr double kSpeed = 5;        // m/s for a grown visitor
constexpr double kTargetAhead = 8;  // m
constexpr double kLongView = 80;    // m
constexpr uint32_t kStepsPerKey = 24;

// At most kMaxPoints of the points, by a seeded hash, still in their order.
std::vector<FloorPoint> thinned(const std::vector<FloorPoint>& points, uint32_t seed) {
  if (points.size() <= kMaxPoints) return points;
  std::vector<std::pair<uint32_t, uint32_t>> order;
  for (uint32_t i = 0; i < points.size(); ++i) order.emplace_back(hash_u32(seed, i, 2u), i);
  std::nth_element(order.begin(), order.begin() + kMaxPoints, order.end());
  std::vector<uint32_t> chosen;
  for (size_t i = 0; i < kMaxPoints; ++i) chosen.push_back(order[i].second);
  std::sort(chosen.begin(), chosen.end());
  std::vector<FloorPoint> kept;
  for (uint32_t i : chosen) kept.push_back(points[i]);
  return kept;
}

uint32_t farthest(const std::vector<double>& distances, const std::vector<uint32_t>& among) {
  uint32_t best = among.front();
  for (uint32_t i : among) {
    if (distances[i] > distances[best]) best = i;
  }
  return best;
}

// Between two of the part's far ends, and on to points that the tour has not come near to yet.
std::vector<glm::dvec3> tour(const WalkGraph& graph, const std::vector<FloorPoint>& points, uint32_t seed) {
  const std::vector<uint32_t>& part = graph.largest_part();
  std::vector<uint32_t> previous;
  uint32_t start = part[hash_u32(seed, 3u) % part.size()];
  uint32_t first = farthest(graph.distances(start, previous), part);
  std::vector<uint32_t> stops{first};
  std::vector<double> from_tour = graph.distances(first, previous);
  for (int leg = 0; leg < 4 && stops.size() < 4 * kMaxCorners; ++leg) {
    std::vector<uint32_t> way = graph.way(stops.back(), farthest(from_tour, part));
    for (size_t i = 1; i < way.size(); ++i) {
      stops.push_back(way[i]);
      std::vector<double> from_here = graph.distances(way[i], previous);
      for (uint32_t p : part) from_tour[p] = std::min(from_tour[p], from_here[p]);
    }
  }
  std::vector<glm::dvec3> corners;
  for (uint32_t stop : stops) corners.push_back(points[stop].eye);
  return corners;
}

// Leaves out corners that can be cut without leaving walkable ground; steps over at most three, so that the
// path keeps its sights.
std::vector<glm::dvec3> straightened(const RayCaster& rays, const std::vector<glm::dvec3>& corners,
                                     const Stature& stature) {
  std::vector<glm::dvec3> kept{corners.front()};
  for (size_t i = 0; i + 1 < corners.size();) {
    size_t next = i + 1;
    for (size_t far = std::min(i + 4, corners.size() - 1); far > next; --far) {
      if (walkable(rays, corners[i], corners[far], stature)) {
        next = far;
        break;
      }
    }
    kept.push_back(corners[next]);
    i = next;
  }
  return kept;
}

// The middle of a leg, at eye height over the floor there if the visitor can step to it.
glm::dvec3 middle(const RayCaster& rays, const glm::dvec3& a, const glm::dvec3& b, const Stature& stature) {
  glm::dvec3 straight = 0.5 * (a + b);
  if (auto floor = rays.nearest(straight, {0, -1, 0}, 2.5 * stature.eye())) {
    glm::dvec3 stood = straight + glm::dvec3(0, stature.eye() - floor->distance, 0);
    if (!rays.nearest(straight, {0, stood.y > straight.y ? 1 : -1, 0},
                      std::abs(stood.y - straight.y) + stature.headroom()) &&
        walkable(rays, a, stood, stature) && walkable(rays, stood, b, stature)) {
      return stood;
    }
  }
  return straight;
}

void refine(const RayCaster& rays, std::vector<glm::dvec3>& corners, const Stature& stature) {
  while (corners.size() < kMinKeys) {
    size_t longest = 0;
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      if (glm::length(corners[i + 1] - corners[i]) > glm::length(corners[longest + 1] - corners[longest]))
        longest = i;
    }
    glm::dvec3 added = middle(rays, corners[longest], corners[longest + 1], stature);
    corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(longest) + 1, added);
  }
}

CameraPath keyed(const std::vector<glm::dvec3>& corners, const Stature& stature) {
  CameraPath path;
  path.name = "default";
  double time = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (i > 0) time += std::max(0.25, glm::length(corners[i] - corners[i - 1]) / (kSpeed * stature.scale));
    path.keys.push_back({time, corners[i], corners[i]});
  }
  return path;
}

// The first key interval in which the spline comes too near to something, if any.
std::optional<size_t> first_blocked(const RayCaster& rays, const CameraPath& path, const Stature& stature) {
  uint32_t steps = kStepsPerKey * static_cast<uint32_t>(path.keys.size());
  glm::dvec3 last(0);
  for (uint32_t step = 0; step < steps; ++step) {
    glm::dvec3 here(path.sample(step, steps, 16, 9, 0.1f, 100).position);
    bool blocked = step > 0 && here != last && !rays.clear(last, here);
    for (int side = 0; side < 6 && !blocked; ++side) {
      glm::dvec3 direction(0);
      direction[side / 2] = side % 2 == 0 ? 1 : -1;
      blocked = rays.nearest(here, direction, 0.25 * stature.scale).has_value();
    }
    if (blocked) {
      double time = path.keys.front().time + path.duration() * step / (steps - 1);
      size_t interval = 0;
      while (interval + 2 < path.keys.size() && path.keys[interval + 1].time < time) ++interval;
      return interval;
    }
    last = here;
  }
  return std::nullopt;
}

// Adds keys where the spline leaves the straight legs too far; where that does not help, the path ends
// before.
CameraPath unobstructed(const RayCaster& rays, std::vector<glm::dvec3> corners, const Stature& stature) {
  for (;;) {
    CameraPath path = keyed(corners, stature);
    if (corners.size() < 2) return path;
    std::optional<size_t> blocked = first_blocked(rays, path, stature);
    if (!blocked) return path;
    size_t i = *blocked;
    double length = glm::length(corners[i + 1] - corners[i]);
    if (corners.size() < kMaxKeys && length > 0.8 * stature.scale) {
      corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     0.5 * (corners[i] + corners[i + 1]));
    } else if (i >= corners.size() / 2) {
      corners.resize(i + 1);
    } else {
      corners.erase(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  }
}

// Each key looks where the view is long, rather ahead than back, and never turns by more than about 110
// degrees from the key before.
void aim(const RayCaster& rays, CameraPath& path, uint32_t seed) {
  constexpr int kDirections = 32;
  constexpr std::array<double, 3> kPitches{-0.03, 0.0, 0.015};  // turns
  glm::dvec3 before(0);
  for (size_t i = 0; i < path.keys.size(); ++i) {
    CameraKey& key = path.keys[i];
    glm::dvec3 ahead =
        path.keys[std::min(i + 1, path.keys.size() - 1)].position - path.keys[i == 0 ? 0 : i - 1].position;
    ahead = glm::length(ahead) > 0 ? glm::normalize(ahead) : glm::dvec3(0);
    double best = -1;
    glm::dvec3 chosen(0, 0, -1);
    for (int d = 0; d < kDirections; ++d) {
      double turns =
          (d + static_cast<double>(unit_float(hash_u32(seed, static_cast<uint32_t>(i), 4u)))) / kDirections;
      for (double pitch : kPitches) {
        double level = cosine_of_turns(pitch);
        glm::dvec3 direction(level * cosine_of_turns(turns), sine_of_turns(pitch),
                             level * sine_of_turns(turns));
        if (glm::dot(direction, before) < -0.35) continue;
        auto hit = rays.nearest(key.position, direction);
        // Open sky shows nothing: worth a short view.
        double view = hit ? std::min(hit->distance, kLongView) : 0.1 * kLongView;
        double score = std::sqrt(view) * (1 + 0.5 * glm::dot(direction, ahead)) *
                       (1 + 0.3 * glm::dot(direction, before));
        if (score > best) {
          best = score;
          chosen = direction;
        }
      }
    }
    key.target = key.position + kTargetAhead * chosen;
    before = chosen;
  }
}

// Standing still and turning round once, from the first key's position.
CameraPath look_round(const glm::dvec3& eye) {
  CameraPath path;
  path.name = "default";
  for (int i = 0; i <= 12; ++i) {
    double turns = i / 12.0;
    path.keys.push_back(
        {2.0 * i, eye, eye + kTargetAhead * glm::dvec3(cosine_of_turns(turns), -0.1, sine_of_turns(turns))});
  }
  return path;
}

CameraPath walk(const RayCaster& rays, const std::vector<FloorPoint>& points, uint32_t seed,
                const Stature& stature) {
  WalkGraph graph(rays, points, stature);
  std::vector<glm::dvec3> corners = tour(graph, points, seed);
  if (corners.size() > 1) {
    corners = straightened(rays, corners, stature);
    if (corners.size() > kMaxCorners) corners.resize(kMaxCorners);
    refine(rays, corners, stature);
    CameraPath path = unobstructed(rays, corners, stature);
    if (path.keys.size() > 1) {
      aim(rays, path, seed);
      return path;
    }
  }
  auto widest = std::max_element(points.begin(), points.end(), [](const FloorPoint& a, const FloorPoint& b) {
    return a.openness < b.openness;
  });
  return look_round(widest->eye);
}

// A walk shows the level: in every frame at least so much of the picture is a surface. Not where the visitor
// stands on a small object and looks past it.
constexpr double kLeastSeen = 0.05;
constexpr uint32_t kColumns = 12, kRows = 12;

bool shows_the_level(const ViewProbe& probe, const CameraPath& path, float near) {
  const uint32_t steps = kStepsPerKey / 4 * static_cast<uint32_t>(path.keys.size());
  for (uint32_t step = 0; step < steps; ++step)
    if (probe.seen(path.sample(step, steps, 1, 1, near, 2 * near), kColumns, kRows) < kLeastSeen)
      return false;
  return true;
}

// Where a key sees too little, it looks somewhat down, along the directions that show most.
void aim_at_surfaces(const ViewProbe& probe, CameraPath& path, float near) {
  constexpr int kDirections = 16;
  constexpr std::array<double, 3> kPitches{-0.03, -0.07, -0.12};  // turns
  const Projection window = Projection::perspective(path.vertical_fov, 1, near, 2 * near);
  for (CameraKey& key : path.keys) {
    double best = probe.seen(Camera::look_at(key.position, key.target, window), kColumns, kRows);
    if (best >= 2 * kLeastSeen) continue;
    for (double pitch : kPitches) {
      for (int d = 0; d < kDirections; ++d) {
        const double turns = static_cast<double>(d) / kDirections, level = cosine_of_turns(pitch);
        const glm::dvec3 target =
            key.position + kTargetAhead * glm::dvec3(level * cosine_of_turns(turns), sine_of_turns(pitch),
                                                     level * sine_of_turns(turns));
        const double seen = probe.seen(Camera::look_at(key.position, target, window), kColumns, kRows);
        if (seen <= best) continue;
        best = seen;
        key.target = target;
      }
    }
  }
}

}  // namespace

CameraPath automatic_path(const Scene& scene, uint32_t seed) {
  RayCaster rays(scene);
  const ViewProbe probe(scene, rays);
  // Within walls if possible; in a level too low for a grown visitor a smaller one walks.
  constexpr std::array<std::pair<double, FloorKind>, 4> kWays{
      {{1, FloorKind::walled}, {0.5, FloorKind::walled}, {0.25, FloorKind::walled}, {1, FloorKind::any}}};
  for (auto [scale, kind] : kWays) {
    Stature stature{scale};
    std::vector<FloorPoint> points =
        thinned(find_floor_points(rays, scene.bounds, seed, stature, kind), seed);
    if (points.empty()) continue;
    CameraPath path = walk(rays, points, seed, stature);
    if (shows_the_level(probe, path, scene.near)) return path;
    aim_at_surfaces(probe, path, scene.near);
    if (shows_the_level(probe, path, scene.near)) return path;
    break;  // what is there to stand on is no place to look from
  }
  return orbit_path(scene, probe, seed);
}

}  // namespace ml
