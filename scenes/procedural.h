// The generators of the procedural scenes. Each is a pure function of the seed; `Scene::origin` stays 0,
// load_scene() moves it.
#pragma once

#include <cstdint>

#include "harness/scene/scene.h"

namespace ml {

// Light defaults of the scenes (scenes.md). The plane's lights are adapted further: LightSet.
inline constexpr LightDefaults kCanyonLights{.placement = Placement::volume, .volume_size = 0.6};
inline constexpr LightDefaults kCitadelLights{
    .placement = Placement::triangle, .triangle_size = 0.8, .area_size = 0.9};
inline constexpr LightDefaults kGroveLights{
    .placement = Placement::area, .radius_ratio = 24, .area_size = 0.5};
inline constexpr LightDefaults kPlaneLights{.placement = Placement::area};
inline constexpr LightDefaults kMuseumLights{.placement = Placement::stage, .radius_ratio = 0};
inline constexpr LightDefaults kArenaLights{.placement = Placement::clumps, .radius_ratio = 0};

// A valley of 190 x 150 x 40 m between two forts, with two box tunnels, a bridge and rocks. Path `default`,
// 40 s: 0 s fort roof looking down the valley, 6.5 s ground run, 12.5 s tunnel, 20.5 s bridge, 26 s inside
// the keep, 30 s (75 %) rim overlook, then back above the valley.
Scene make_canyon(uint32_t seed);

// A hill town within a ring wall, a keep on top, farms and woods around: 760 x 760 x 100 m. Path `default`,
// 60 s: 0 s approach from 330 m, 15 s gate, 17 s streets, 38 s wall walk, 47 s roof of the keep, 51 s spiral
// out.
Scene make_citadel(uint32_t seed);

// A wood of 300 x 300 m with a winding path between two picket fences, lit by lamps: thin things before far
// ones, the worst case for depth bounds. Path `default`, 40 s.
Scene make_grove(uint32_t seed);

// 5 x 3 rooms of 14 m, 7.5 m high, under one closed ceiling: doorways in line, 60 columns, plinths with
// exhibits. Every pixel is a near wall or one some rooms away. Path `default`, 60 s, through twelve rooms.
Scene make_museum(uint32_t seed);

// 90 x 90 m with 450 objects (crates, ramps, walls, tents, trees) and a house of one room, 12 x 12 m. Path
// `default`, 40 s, on foot and above the roofs; path `room`, 20 s, within that room.
Scene make_arena(uint32_t seed);

// 100 x 100 m at y = 0, two triangles. Path `default` glides and keeps the edges mostly out of sight; path
// `above` stands still, looks straight down, and sees nothing that is nearer than 8 m to an edge in a 16:9
// picture.
Scene make_plane();

}  // namespace ml
