// The generators of the procedural scenes. Each is a pure function of the seed; `Scene::origin` stays 0,
// load_scene() moves it.
#pragma once

#include <cstdint>

#include "harness/scene/scene.h"

namespace ml {

// A valley of 190 x 150 x 40 m between two forts, with two box tunnels, a bridge and rocks. Path `default`,
// 40 s: 0 s fort roof looking down the valley, 6.5 s ground run, 12.5 s tunnel, 20.5 s bridge, 26 s inside
// the keep, 30 s (75 %) rim overlook, then back above the valley.
Scene make_canyon(uint32_t seed);

// 100 x 100 m at y = 0, two triangles. Path `default` glides and keeps the edges mostly out of sight; path
// `above` stands still, looks straight down, and sees nothing that is nearer than 8 m to an edge in a 16:9
// picture.
Scene make_plane();

}  // namespace ml
