#include <gtest/gtest.h>

#include <set>

#include "harness/base/error.h"
#include "harness/lights/stage.h"
#include "level_checks.h"
#include "scenes/museum/parts.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

const Scene& museum() {
  static const Scene scene = make_scene("museum");
  return scene;
}

const RayCaster& museum_rays() {
  static const RayCaster rays(museum());
  return rays;
}

std::vector<Light> stage_lights(uint32_t count, uint32_t seed = 1) {
  LightSpec spec;
  spec.count = count;
  spec.seed = seed;
  LightSet set(spec, museum());
  EXPECT_TRUE(set.rejected().empty());
  return set.base();
}

TEST(Museum, HasTheRoomsAndTheColumnsOfItsDescription) {
  const Wanted& wanted = describe_scene("museum").wanted;
  expect_in(wanted.number("rooms"), static_cast<double>(museum().rooms.size()), "rooms");
  for (const Bounds& room : museum().rooms)
    expect_in(wanted.number("room_height"), room.size().y, "room_height");
  MeshBuilder mesh;
  mesh.add_material({});
  expect_in(wanted.number("columns"), build_museum_columns(mesh, MuseumMaterials{}), "columns");
}

// From the middle of each room through its doorways into the next, and on to the far wall.
TEST(Museum, DoorwaysAreInLine) {
  auto eye = [](int i, int k) { return museum_room(i, k) + glm::dvec3(0, 1.7, 0); };
  for (int k = 0; k < kMuseumRoomsZ; ++k) EXPECT_TRUE(museum_rays().clear(eye(0, k), eye(4, k))) << k;
  for (int i = 0; i < kMuseumRoomsX; ++i) EXPECT_TRUE(museum_rays().clear(eye(i, 0), eye(i, 2))) << i;
  EXPECT_FALSE(museum_rays().clear(eye(0, 0), eye(1, 2)));
}

TEST(Museum, NoPixelSeesTheSky) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    Scene scene = make_scene("museum", seed);
    RayCaster rays(scene);
    for (uint32_t frame = 0; frame < 120; ++frame) {
      Camera camera = scene.paths[0].sample(frame, 120, 64, 36, scene.near, scene.far);
      DepthProbe seen = probe(rays, camera);
      ASSERT_EQ(seen.depths.size(), 64u * 36u) << frame;
      EXPECT_LT(seen.depths.back(), scene.far);
    }
  }
  // Nor does any other view from within a room.
  Random random(5);
  for (const Bounds& room : museum().rooms) {
    for (int i = 0; i < 2000; ++i) {
      double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
      EXPECT_TRUE(museum_rays().nearest(glm::dvec3(room.center()), {x, y, z + 1e-9}));
    }
  }
}

TEST(MuseumLights, AreThoseOfTheirDescription) {
  for (uint32_t count : {80u, 160u, 200u, 240u, 1000u}) {
    std::vector<Light> lights = stage_lights(count);
    ASSERT_EQ(lights.size(), count);
    std::vector<uint32_t> by_shape(light_shape_names().size());
    uint32_t wide = 0;
    for (const Light& light : lights) {
      ++by_shape[static_cast<size_t>(light.shape)];
      if (!has_cone(light.shape)) continue;
      double half_angle = light.outer_angle * 180 / 3.141592653589793;
      double tilt = std::acos(-static_cast<double>(light.direction.y)) * 180 / 3.141592653589793;
      EXPECT_NEAR(light.position.y, 6.8, 1e-6);
      EXPECT_GE(light.radius, 8);
      EXPECT_LE(light.radius, 20);
      if (half_angle > 30.001) {
        ++wide;
        continue;
      }
      EXPECT_GE(half_angle, 13.999);
      EXPECT_GE(tilt, 24.99);
      EXPECT_LE(tilt, 65.01);
    }
    auto number = [&](LightShape shape) { return by_shape[static_cast<size_t>(shape)]; };
    EXPECT_EQ(wide, kWideSpots);
    EXPECT_EQ(number(LightShape::omni), kFillPoints);
    EXPECT_NEAR(number(LightShape::capsule), count / 20.0, 2);
    EXPECT_NEAR(number(LightShape::wedge), count / 20.0, 2);
    EXPECT_NEAR(number(LightShape::box), count / 40.0, 2);
    EXPECT_GT(number(LightShape::box), 0u);
    EXPECT_GT(number(LightShape::spot), 0.75 * count);
  }
}

// As many in one room as in any other, and the same light whatever the count is.
TEST(MuseumLights, AreSpreadOverTheRoomsAndKeepTheirPositions) {
  std::vector<Light> many = stage_lights(300), few = stage_lights(37);
  std::vector<uint32_t> in_room(15);
  for (const Light& light : many) {
    int rooms = 0;
    for (size_t r = 0; r < 15; ++r) {
      const Bounds& room = museum().rooms[r];
      glm::vec3 p(light.position);
      if (!(glm::all(glm::greaterThan(p, room.min)) && glm::all(glm::lessThan(p, room.max)))) continue;
      ++in_room[r];
      ++rooms;
    }
    EXPECT_EQ(rooms, 1);
  }
  for (uint32_t count : in_room) EXPECT_EQ(count, 20u);
  for (size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].position, many[i].position);
    EXPECT_EQ(few[i].shape, many[i].shape);
    EXPECT_EQ(few[i].radius, many[i].radius);
  }
  EXPECT_NE(stage_lights(1, 2)[0].position, many[0].position);
}

// How far (m) the light's volume reaches from its position along a unit direction.
double reach(const Light& light, const glm::dvec3& along) {
  if (light.shape == LightShape::box) {
    glm::dvec3 half(light.half_extents);
    double reached = half.x * std::abs(glm::dot(glm::dvec3(light.side), along));
    reached += half.y * std::abs(glm::dot(glm::dvec3(glm::cross(light.direction, light.side)), along));
    return reached + half.z * std::abs(glm::dot(glm::dvec3(light.direction), along));
  }
  double reached = light.radius;
  if (has_cone(light.shape)) {
    double cosine = glm::clamp(glm::dot(glm::dvec3(light.direction), along), -1.0, 1.0);
    double beyond = std::max(std::acos(cosine) - double{light.outer_angle}, 0.0);
    reached *= std::max(std::cos(beyond), 0.0);
  }
  if (has_segment(light.shape))
    reached += double{light.half_length} * std::abs(glm::dot(glm::dvec3(light.side), along));
  return reached;
}

// Is the light's volume wholly outside none of the view's six planes?
bool in_view(const Light& light, const Camera& camera) {
  const Projection& p = camera.projection;
  glm::dvec3 right(camera.right), up(camera.up), forward(camera.forward);
  glm::dvec3 to = light.position - glm::dvec3(camera.position);
  auto inside = [&](const glm::dvec3& inward, double offset) {
    double length = glm::length(inward);
    return glm::dot(inward, to) / length + reach(light, inward / length) > offset;
  };
  return inside(forward, p.near) && inside(-forward, -double{p.far}) &&
         inside(double{p.right} * forward - right, 0) && inside(right - double{p.left} * forward, 0) &&
         inside(double{p.top} * forward - up, 0) && inside(up - double{p.bottom} * forward, 0);
}

TEST(MuseumLights, AboutHalfOfThemAreInView) {
  for (uint32_t count : {80u, 160u, 240u}) {
    double sum = 0;
    for (uint32_t seed : {1u, 2u, 3u}) {
      for (const Light& light : stage_lights(count, seed)) {
        for (uint32_t frame = 0; frame < 120; ++frame)
          sum += in_view(light, museum().paths[0].sample(frame, 120, 1280, 720, museum().near, museum().far));
      }
    }
    const std::string name = "in_view_of_" + std::to_string(count);
    expect_in(describe_scene("museum").wanted.number(name), sum / 360, name);
  }
}

TEST(MuseumLights, ScriptsNeverReturnARefusedLight) {
  for (LightScript script : {LightScript::drift, LightScript::spawn, LightScript::orbit}) {
    LightSpec spec;
    spec.count = 240;
    spec.script = script;
    LightSet set(spec, museum());
    std::vector<Light> out;
    for (uint32_t frame = 0; frame < 100; ++frame) {
      set.at(frame, 100, 60, out);
      EXPECT_GT(out.size(), 120u);
      for (const Light& light : out) ASSERT_EQ(rejection_reason(light), nullptr);
    }
  }
}

TEST(MuseumLights, StageSaysWhatItCannotDo) {
  LightSpec spec;
  spec.count = 10;
  spec.placement = Placement::stage;
  auto refusal = [](const LightSpec& of, const Scene& scene) -> std::string {
    try {
      LightSet set(of, scene);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  Scene canyon = make_scene("canyon");
  EXPECT_NE(refusal(spec, canyon).find("no rooms for placement 'stage'"), std::string::npos);
  spec.placement = Placement::room;
  EXPECT_NE(refusal(spec, canyon).find("no rooms for placement 'room'"), std::string::npos);
  spec.placement = Placement::stage;
  spec.box_fraction = 0.1f;
  EXPECT_NE(refusal(spec, museum()).find("'stage' has shapes of its own"), std::string::npos);
  // One radius for all of them, boxes too.
  spec.box_fraction = 0;
  spec.count = 100;
  spec.radius = 3;
  LightSet equal(spec, museum());
  EXPECT_TRUE(equal.rejected().empty());
  for (const Light& light : equal.base()) EXPECT_NEAR(light.radius, 3, 1e-5);
}

}  // namespace
}  // namespace ml
