// Whether a camera sees anything of a level, by a few rays on the CPU: for paths that nobody has looked
// along.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/scene/ray_caster.h"
#include "harness/scene/scene.h"

namespace ml {

class ViewProbe {
 public:
  // `rays` is of the same scene, and both outlive the probe.
  ViewProbe(const Scene& scene, const RayCaster& rays);

  // The share of `columns` x `rows` rays through the picture that end on a surface which is drawn: beyond
  // near, and on its front unless its material is double-sided. Alpha masks are taken as solid.
  double seen(const Camera& camera, uint32_t columns, uint32_t rows) const;

 private:
  const RayCaster& rays_;
  std::vector<bool> double_sided_;  // by triangle
};

}  // namespace ml
