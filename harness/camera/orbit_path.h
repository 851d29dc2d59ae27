// A camera path around a level or an object, from outside, that sees something in every frame.
#pragma once

#include "harness/camera/view_probe.h"
#include "harness/scene/scene.h"

namespace ml {

// Once around the bounding sphere, which fills the picture; where surfaces show from some sides alone, to and
// fro before those. A level of which nothing shows even so (what is there is small against its bounds) is
// looked at by its largest triangle. Seeded, deterministic; at least two keys.
CameraPath orbit_path(const Scene& scene, const ViewProbe& probe, uint32_t seed);

}  // namespace ml
