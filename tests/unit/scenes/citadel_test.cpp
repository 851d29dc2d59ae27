#include <gtest/gtest.h>

#include "level_checks.h"
#include "scenes/citadel/parts.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

TEST(Citadel, HasTheHillAndTheHousesOfItsDescription) {
  const Wanted& wanted = describe_scene("citadel").wanted;
  HeightField ground = make_citadel_ground(1);
  expect_in(wanted.number("hill"), ground.height(0, 0), "hill");
  MeshBuilder mesh;
  CitadelMaterials materials{};
  mesh.add_material({});
  Random random(1);
  expect_in(wanted.number("houses"), build_town(mesh, materials, ground, random), "houses");
}

}  // namespace
}  // namespace ml
