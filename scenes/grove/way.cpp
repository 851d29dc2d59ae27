#include <algorithm>
#include <cmath>

#include "harness/scene/turn.h"
#include "harness/scene/turned_mesh.h"
#include "scenes/grove/parts.h"

namespace ml {
namespace {

constexpr unsigned kNoBottom = MeshBuilder::all & ~static_cast<unsigned>(MeshBuilder::bottom);
constexpr double kEnd = 128;  // m, |z| of the way's ends
constexpr double kLampEvery = 12;

glm::dvec2 middle(double z) {
  return {17 * sine_of_turns(z / 150) + 5 * sine_of_turns(z / 67 + 0.2) - 4.76, z};
}

double length_of(const glm::dvec2& v) {
  return std::sqrt(glm::dot(v, v));
}

}  // namespace

GroveWay::GroveWay() {
  constexpr int kSteps = 2048;
  for (int i = 0; i <= kSteps; ++i) {
    glm::dvec2 point = middle(-kEnd + 2 * kEnd * i / kSteps);
    double length = i == 0 ? 0 : steps_.back().length + length_of(point - steps_.back().point);
    steps_.push_back({length, point});
  }
}

GroveWay::WayPoint GroveWay::at(double length) const {
  auto after = std::upper_bound(steps_.begin() + 1, steps_.end() - 1, length,
                                [](double l, const Step& step) { return l < step.length; });
  const Step &a = *(after - 1), &b = *after;
  glm::dvec2 step = b.point - a.point;
  double share = (length - a.length) / (b.length - a.length);
  return {a.point + share * step, step / length_of(step)};
}

double GroveWay::distance(const glm::dvec2& point) const {
  double least = length_of(point - steps_.front().point);
  for (size_t i = 0; i < steps_.size(); i += 4) least = std::min(least, length_of(point - steps_[i].point));
  return least;
}

void build_fences(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                  const GroveWay& way) {
  constexpr int kSlatsPerPost = 15;
  constexpr double kHalfWidth = 0.04, kHigh = 1.1;
  for (double side : {-1.0, 1.0}) {
    auto foot = [&](double length) {
      glm::dvec2 position = way.at(length).beside(side * kFenceOffset);
      return glm::dvec3(position.x, ground.height(position.x, position.y), position.y);
    };
    double pitch = way.length() / kSlats;
    for (int i = 0; i < kSlats; ++i) {
      double length = (i + 0.5) * pitch;
      glm::dvec3 position = foot(length);
      glm::dvec2 ahead = way.at(length).ahead;
      // Local z runs along the way, local x to its left; the slats stand on the way's side of the rails.
      TurnedMesh slat(mesh, position, ahead);
      double x = side * 0.04;
      slat.box({x - 0.012, -0.1, -kHalfWidth}, {x + 0.012, kHigh, kHalfWidth}, materials.picket, kNoBottom);
    }
    for (int i = 0; i < kSlats; i += kSlatsPerPost) {
      glm::dvec3 a = foot(i * pitch), b = foot((i + kSlatsPerPost) * pitch);
      TurnedMesh post(mesh, a, way.at(i * pitch).ahead);
      post.box({-0.05, -0.3, -0.05}, {0.05, kHigh + 0.12, 0.05}, materials.timber, kNoBottom);
      glm::dvec2 along(b.x - a.x, b.z - a.z);
      TurnedMesh rail(mesh, a, along);
      double length = length_of(along), rise = b.y - a.y;
      for (double y : {0.3, 0.85}) {
        std::array<glm::dvec3, 8> corners;
        for (size_t c = 0; c < 8; ++c) {
          corners[c] = {c & 1 ? 0.025 : -0.025, y + (c & 2 ? 0.09 : 0) + (c & 4 ? rise : 0),
                        c & 4 ? length : 0};
        }
        rail.block(corners, materials.timber);
      }
    }
  }
}

void build_lamps(MeshBuilder& mesh, const GroveMaterials& materials, const HeightField& ground,
                 const GroveWay& way) {
  double side = 1;
  for (double length = 0.5 * kLampEvery; length < way.length(); length += kLampEvery, side = -side) {
    GroveWay::WayPoint lamp = way.at(length);
    glm::dvec2 foot = lamp.beside(side * (kFenceOffset + 0.45));
    glm::dvec3 base(foot.x, ground.height(foot.x, foot.y) - 0.2, foot.y);
    mesh.prism(base, 0.55, 0.16, 0.1, 6, materials.iron);
    mesh.prism(base + glm::dvec3(0, 0.55, 0), 3.05, 0.055, 0.045, 6, materials.iron);
    // An arm over the fence, and the lantern at its end.
    glm::dvec2 over = lamp.point - foot;
    TurnedMesh arm(mesh, base + glm::dvec3(0, 3.4, 0), over);
    arm.box({-0.03, 0, -0.1}, {0.03, 0.06, 0.95}, materials.iron);
    glm::dvec3 lantern = arm.point(0, -0.42, 0.85);
    mesh.box(lantern - glm::dvec3(0.11, 0, 0.11), lantern + glm::dvec3(0.11, 0.32, 0.11), materials.lamp);
    mesh.cone(lantern + glm::dvec3(0, 0.32, 0), 0.16, 0.2, 6, materials.iron);
  }
}

}  // namespace ml
