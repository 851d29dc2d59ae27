#include "scenes/citadel/parts.h"

namespace ml {
namespace {

constexpr double kTurn = 6.283185307179586;

// Collects keys in cylinder coordinates about the hill's top.
class Walk {
 public:
  Walk(const HeightField& ground, std::vector<CameraKey>& keys) : ground_(ground), keys_(keys) {}

  glm::dvec3 above(double turns, double radius, double eye) const {
    glm::dvec3 place = citadel_place(turns, radius, 0);
    place.y = ground_.height(place.x, place.z) + eye;
    return place;
  }
  void key(double time, const glm::dvec3& position, const glm::dvec3& target) {
    keys_.push_back({time, position, target});
  }
  // Along a ring street at eye height, looking 13 m ahead.
  void ring(double radius, double t0, double turns0, double t1, double turns1, int steps) {
    for (int i = 0; i <= steps; ++i) {
      double share = static_cast<double>(i) / steps, turns = turns0 + share * (turns1 - turns0);
      key(t0 + share * (t1 - t0), above(turns, radius, 2),
          above(turns + 13 / (kTurn * radius), radius + 0.5, 2.2));
    }
  }
  // Along the wall walk, looking ahead and ever more outward.
  void wall(double t0, double turns0, double t1, double turns1, int steps) {
    for (int i = 0; i <= steps; ++i) {
      double share = static_cast<double>(i) / steps, turns = turns0 + share * (turns1 - turns0);
      key(t0 + share * (t1 - t0), citadel_place(turns, kWallAxis, kWallWalk + 1.9),
          citadel_place(turns + 0.05, kWallAxis + 2 + 24 * share, kWallWalk + 1.5 - 3 * share));
    }
  }

 private:
  const HeightField& ground_;
  std::vector<CameraKey>& keys_;
};

}  // namespace

CameraPath make_citadel_path(const HeightField& ground) {
  CameraPath path;
  path.name = "default";
  Walk walk(ground, path.keys);
  auto at = citadel_place;

  // The approach, from high above the fields down to the gate.
  walk.key(0, walk.above(0.04, 330, 48), at(0, 0, 32));
  walk.key(3, walk.above(0.052, 285, 46), at(0, 0, 28));
  walk.key(6, walk.above(0.042, 235, 40), at(0, 20, 26));
  walk.key(9, walk.above(0.015, 185, 22), at(0, 50, 22));
  walk.key(11.5, walk.above(0, 148, 7), at(0, 90, 18));
  walk.key(13.3, walk.above(0, 124, 2.6), at(0, 88, 18));
  walk.key(15, walk.above(0, 106, 2.2), at(0, 80, 20.5));
  // Through the gate and along three ring streets, each nearer to the keep.
  walk.key(16.2, walk.above(0, 94.5, 2), walk.above(0.012, 83, 2));
  walk.ring(kOuterStreet, 17.4, 0.012, 22.4, 0.113, 6);
  walk.key(23.2, walk.above(0.125, 84, 2), walk.above(0.1255, 70, 2.2));
  walk.key(24.4, walk.above(0.125, 71.5, 2), walk.above(0.135, 62, 2.2));
  walk.ring(kMiddleStreet, 25.4, 0.139, 29, 0.235, 5);
  walk.key(29.8, walk.above(0.25, 62, 2), walk.above(0.2505, 48, 2.2));
  walk.key(31, walk.above(0.25, 49, 2), walk.above(0.263, 41, 2.2));
  walk.ring(kInnerStreet, 31.9, 0.272, 34, 0.352, 4);
  // Up over the roofs to the wall walk.
  walk.key(34.8, walk.above(0.375, 47, 4.5), at(0.385, 62, 30));
  walk.key(35.7, walk.above(0.378, 62, 13), at(0.4, 85, 30));
  walk.key(36.7, at(0.393, 86, 33), at(0.425, 104, 24));
  walk.key(37.5, at(0.409, 100, 27), at(0.445, 106, 22.5));
  walk.wall(38.3, 0.424, 43.3, 0.545, 8);
  // Over the roofs to the keep, round half its roof.
  walk.key(44.2, at(0.556, 97, 28), at(0.555, 60, 31));
  walk.key(45.3, at(0.548, 62, 41), at(0.52, 20, 45));
  walk.key(46.5, at(0.515, 28, 51), at(0.45, 9, 49));
  walk.key(47.3, at(0.505, 10.2, 48.9), at(0.62, 30, 44));
  walk.key(48.3, at(0.58, 8.2, 48.3), at(0.66, 110, 22));
  walk.key(49.6, at(0.68, 8.2, 48.3), at(0.74, 160, 16));
  walk.key(50.6, at(0.745, 9.2, 48.6), at(0.8, 170, 14));
  // The spiral out, turning round to the citadel.
  walk.key(51.5, at(0.76, 15.5, 51), at(0.85, 150, 14));
  walk.key(52.6, at(0.8, 34, 58), at(0.95, 130, 14));
  walk.key(54, at(0.88, 75, 70), at(1.05, 110, 12));
  walk.key(55.6, at(0.98, 140, 82), at(1.15, 70, 10));
  walk.key(57.5, at(1.09, 215, 86), at(1.3, 40, 12));
  walk.key(60, at(1.2, 305, 78), at(1.4, 30, 16));
  return path;
}

}  // namespace ml
