// 5 x 3 rooms of 14 m, 7.5 m high, under one closed ceiling: doorways in line, columns, plinths with
// exhibits.
#pragma once

#include "scenes/scene_registry.h"

namespace ml {

SceneEntry museum_scene();

}  // namespace ml
