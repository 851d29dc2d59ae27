// A hill town within a ring wall, a keep on top, farms and woods around: 760 x 760 x 100 m.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry citadel_scene();

}  // namespace ml
