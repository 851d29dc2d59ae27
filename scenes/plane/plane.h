// 100 x 100 m at y = 0, two triangles.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry plane_scene();

}  // namespace ml
