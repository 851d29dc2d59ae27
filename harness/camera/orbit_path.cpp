#include "harness/camera/orbit_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "harness/base/random.h"
#include "harness/scene/turn.h"

namespace ml {
namespace {

constexpr int kSteps = 24;        // directions of a ring
constexpr int kKeys = 12;         // intervals of a path
constexpr double kDuration = 40;  // s
constexpr uint32_t kRays = 24;    // a side of the picture
constexpr uint32_t kChecks = 96;  // views along a path
// Of a full turn, about the horizontal: from a little above first, from straight above and below last.
constexpr std::array<double, 7> kElevations{0.064, 0.14, 0, -0.064, -0.14, 0.22, -0.22};
// The bounding sphere, as a multiple of whose radius the camera keeps away: at 60 degrees it touches the
// picture's edge at 2.
constexpr double kDistance = 1.9;
// A direction counts where it shows at least this part of what the best one shows.
constexpr double kWorthwhile = 0.2;

struct Ball {
  glm::dvec3 center{0};
  double radius = 0.25;  // m
};

Ball around_bounds(const Bounds& bounds) {
  const glm::dvec3 low(bounds.min), high(bounds.max);
  Ball ball{0.5 * (low + high), 0.5 * glm::length(high - low)};
  if (!(ball.radius > 0)) ball.radius = Ball().radius;
  return ball;
}

struct Orbit {
  Ball ball;
  double elevation = kElevations[0];  // turns
  double begin = 0, end = 1;          // azimuth, turns
  bool closed() const { return end - begin >= 1; }
};

glm::dvec3 direction_of(double elevation, double azimuth) {
  const double level = cosine_of_turns(elevation);
  return {level * cosine_of_turns(azimuth), sine_of_turns(elevation), level * sine_of_turns(azimuth)};
}

CameraPath path_of(const Orbit& orbit, float near) {
  CameraPath path;
  path.name = "default";
  // In front of the whole ball, and not so near that depth loses its digits.
  const auto nearest = static_cast<float>(0.25 * (kDistance - 1) * orbit.ball.radius);
  if (nearest < near) path.own_near = nearest;
  for (int i = 0; i <= kKeys; ++i) {
    double along = static_cast<double>(i) / kKeys;
    if (!orbit.closed()) along = 1 - std::abs(2 * along - 1);  // there and back
    const double azimuth = orbit.begin + along * (orbit.end - orbit.begin);
    path.keys.push_back(
        {kDuration * i / kKeys,
         orbit.ball.center + kDistance * orbit.ball.radius * direction_of(orbit.elevation, azimuth),
         orbit.ball.center});
  }
  return path;
}

class OrbitFinder {
 public:
  OrbitFinder(const Scene& scene, const ViewProbe& probe) : scene_(scene), probe_(probe) {}

  // The first whole ring that sees something all around, else the widest arc; none where nothing shows.
  std::optional<Orbit> find(const Ball& ball, double begin) const {
    std::array<std::array<double, kSteps>, kElevations.size()> seen{};
    double best = 0;
    for (size_t e = 0; e < kElevations.size(); ++e) {
      for (int i = 0; i < kSteps; ++i) {
        seen[e][static_cast<size_t>(i)] =
            share({ball, kElevations[e]}, begin + static_cast<double>(i) / kSteps);
        best = std::max(best, seen[e][static_cast<size_t>(i)]);
      }
    }
    if (best == 0) return std::nullopt;
    std::vector<Orbit> arcs;
    for (size_t e = 0; e < kElevations.size(); ++e) {
      const Orbit ring{ball, kElevations[e], begin, begin + 1};
      if (std::all_of(seen[e].begin(), seen[e].end(), [&](double s) { return s >= kWorthwhile * best; }) &&
          always_sees(ring))
        return ring;
      add_arcs(ring, seen[e], kWorthwhile * best, arcs);
    }
    std::stable_sort(arcs.begin(), arcs.end(),
                     [](const Orbit& a, const Orbit& b) { return a.end - a.begin > b.end - b.begin; });
    for (Orbit arc : arcs) {
      // Narrower and narrower about the middle, down to a camera that hardly moves.
      for (int narrowed = 0; narrowed < 12; ++narrowed) {
        if (always_sees(arc)) return arc;
        const double middle = 0.5 * (arc.begin + arc.end), half = 0.25 * (arc.end - arc.begin);
        arc.begin = middle - half, arc.end = middle + half;
      }
    }
    return std::nullopt;
  }

 private:
  double share(const Orbit& orbit, double azimuth) const {
    const glm::dvec3 eye =
        orbit.ball.center + kDistance * orbit.ball.radius * direction_of(orbit.elevation, azimuth);
    const CameraPath path = path_of(orbit, scene_.near);
    const float near = path.own_near > 0 ? path.own_near : scene_.near;
    const Projection window = Projection::perspective(path.vertical_fov, 1, near, 2 * near);
    return probe_.seen(Camera::look_at(eye, orbit.ball.center, window), kRays, kRays);
  }

  bool always_sees(const Orbit& orbit) const {
    const CameraPath path = path_of(orbit, scene_.near);
    for (uint32_t i = 0; i < kChecks; ++i)
      if (probe_.seen(path.sample(i, kChecks, 1, 1, scene_.near, 2 * scene_.near), kRays, kRays) == 0)
        return false;
    return true;
  }

  // The runs of worthwhile directions of a ring, around its seam too.
  static void add_arcs(const Orbit& ring, const std::array<double, kSteps>& seen, double least,
                       std::vector<Orbit>& arcs) {
    for (int first = 0; first < kSteps; ++first) {
      auto worthwhile = [&](int i) { return seen[static_cast<size_t>((i + kSteps) % kSteps)] >= least; };
      if (!worthwhile(first) || worthwhile(first - 1)) continue;
      int count = 1;
      while (count < kSteps && worthwhile(first + count)) ++count;
      Orbit arc = ring;
      arc.begin = ring.begin + static_cast<double>(first) / kSteps;
      arc.end = arc.begin + std::max(0.1, count - 1.0) / kSteps;
      arcs.push_back(arc);
    }
  }

  const Scene& scene_;
  const ViewProbe& probe_;
};

// For surfaces that are too small against the bounds to be hit by a ray: towards the largest triangle and
// away from it, before its front.
CameraPath before_the_largest_triangle(const Scene& scene) {
  double largest = 0;
  Ball ball;
  glm::dvec3 normal(0, 0, 1);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    glm::dvec3 corners[3];
    for (uint32_t c = 0; c < 3; ++c)
      corners[c] = glm::dvec3(scene.vertices[scene.indices[3 * t + c]].position);
    const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::length(cross);
    if (!(area > largest)) continue;
    largest = area;
    normal = cross / area;
    ball.center = (corners[0] + corners[1] + corners[2]) / 3.0;
    ball.radius = 0;
    for (const glm::dvec3& corner : corners)
      ball.radius = std::max(ball.radius, glm::length(corner - ball.center));
  }
  CameraPath path;
  path.name = "default";
  const auto nearest = static_cast<float>(0.25 * (kDistance - 1) * ball.radius);
  if (nearest < scene.near) path.own_near = nearest;
  for (int i = 0; i <= kKeys; ++i) {
    const double away = kDistance * (1 + 0.2 * (1 - std::abs(2.0 * i / kKeys - 1)));
    path.keys.push_back({kDuration * i / kKeys, ball.center + away * ball.radius * normal, ball.center});
  }
  return path;
}

}  // namespace

CameraPath orbit_path(const Scene& scene, const ViewProbe& probe, uint32_t seed) {
  const double begin = static_cast<double>(unit_float(hash_u32(seed, 5u)));
  const Ball ball = around_bounds(scene.bounds);
  if (scene.triangle_count() == 0) return path_of({ball, kElevations[0], begin, begin + 1}, scene.near);
  if (std::optional<Orbit> orbit = OrbitFinder(scene, probe).find(ball, begin))
    return path_of(*orbit, scene.near);
  return before_the_largest_triangle(scene);
}

}  // namespace ml
