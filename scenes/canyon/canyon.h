// A valley of 190 x 150 x 40 m between two forts, with two box tunnels, a bridge and rocks.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry canyon_scene();

}  // namespace ml
