// 90 x 90 m with objects of five kinds and a house of one room, 12 x 12 m.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry arena_scene();

}  // namespace ml
