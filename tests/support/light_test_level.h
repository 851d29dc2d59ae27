// A small level and helpers that the tests of lights share.
#pragma once

#include <tuple>
#include <vector>

#include "harness/lights/set.h"
#include "harness/scene/mesh_builder.h"

namespace ml {

// A box of 40 x 20 x 10 m and, far smaller in area, a needle: triangles are not alike.
inline const Scene& level() {
  static const Scene scene = [] {
    MeshBuilder mesh;
    uint32_t material = mesh.add_material({});
    mesh.box({-20, 0, -5}, {20, 20, 5}, material);
    mesh.box({-1, 0, -1}, {1, 1, 1}, material);
    Scene built = mesh.finish();
    built.name = "boxes";
    return built;
  }();
  return scene;
}

inline LightSpec spec_of(uint32_t count, Placement placement = Placement::volume) {
  LightSpec spec;
  spec.count = count;
  spec.placement = placement;
  return spec;
}

inline bool same_bits(const std::vector<Light>& a, const std::vector<Light>& b) {
  auto key = [](const Light& l) {
    return std::make_tuple(l.position.x, l.position.y, l.position.z, l.radius, l.intensity.x, l.intensity.y,
                           l.intensity.z, l.shape, l.direction.x, l.direction.y, l.direction.z, l.inner_angle,
                           l.outer_angle, l.side.x, l.side.y, l.side.z, l.half_length, l.half_extents.x,
                           l.half_extents.y, l.half_extents.z);
  };
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (key(a[i]) != key(b[i])) return false;
  }
  return true;
}

}  // namespace ml
