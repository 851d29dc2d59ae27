#include <gtest/gtest.h>

#include "harness/lights/set.h"
#include "level_checks.h"
#include "scenes/arena/parts.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

const Scene& arena() {
  static const Scene scene = make_scene("arena");
  return scene;
}

TEST(Arena, HasTheObjectsAndTheRoomOfItsDescription) {
  const Wanted& wanted = describe_scene("arena").wanted;
  ASSERT_EQ(arena().rooms.size(), 1u);
  expect_in(wanted.number("room_width"), arena().rooms[0].size().x, "room_width");
  expect_in(wanted.number("room_width"), arena().rooms[0].size().z, "room_width");
  MeshBuilder mesh;
  mesh.add_material({});
  Random random(1);
  expect_in(wanted.number("objects"), build_arena_objects(mesh, ArenaMaterials{}, random, {}), "objects");
}

TEST(ArenaLights, FiftyInOneRoomReachNearlyEveryPixel) {
  LightSpec spec;
  spec.count = 50;
  spec.placement = Placement::room;
  LightSet set(spec, arena());
  ASSERT_EQ(set.base().size(), 50u);
  for (const Light& light : set.base()) {
    EXPECT_EQ(light.radius, 8);
    // 2.5 m from the walls; within the middle half of the height.
    EXPECT_LE(std::abs(light.position.x - kRoomX), kRoomHalf - 2.499);
    EXPECT_LE(std::abs(light.position.z - kRoomZ), kRoomHalf - 2.499);
    EXPECT_GE(light.position.y, 0.249 * kRoomHeight);
    EXPECT_LE(light.position.y, 0.751 * kRoomHeight);
  }
  const RayCaster rays(arena());
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    spec.seed = seed;
    LightsSeen seen = lights_seen(arena(), rays, arena().path("room"), LightSet(spec, arena()));
    expect_in(describe_scene("arena").wanted.number("lights_per_point_in_the_room"), seen.mean, "mean");
  }
}

}  // namespace
}  // namespace ml
