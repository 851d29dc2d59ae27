// A wood of 300 x 300 m with a winding path between two picket fences, lit by lamps.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry grove_scene();

}  // namespace ml
