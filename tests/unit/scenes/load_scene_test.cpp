#include "scenes/load_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/lights/radius_distribution.h"
#include "level_checks.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

TEST(LoadScene, OffsetMovesOnlyTheOrigin) {
  SceneSpec spec;
  spec.procedural = "canyon";
  Scene here = load_scene(spec);
  spec.offset = {1e6, -2e5, 1e9};
  Scene there = load_scene(spec);
  EXPECT_EQ(hash_of(here), hash_of(there));
  EXPECT_EQ(there.origin - here.origin, spec.offset);
}

TEST(LoadScene, RefusesWhatItCannotLoad) {
  SceneSpec spec;
  EXPECT_THROW(load_scene(spec), UsageError);
  spec.procedural = "cannyon";
  try {
    load_scene(spec);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'canyon'"), std::string::npos) << error.what();
  }
  spec.gltf = "level.glb";
  EXPECT_THROW(load_scene(spec), UsageError);
  spec = {};
  spec.procedural = "plane";
  for (double bad : {1.1e9, -1e300, std::nan("")}) {
    spec.offset = {0, bad, 0};
    EXPECT_THROW(load_scene(spec), UsageError);
  }
}

TEST(LoadScene, LightDefaultsAreKnownWithoutMakingTheScene) {
  for (const SceneEntry& entry : scene_registry()) {
    const SceneDescription& info = entry.description;
    SceneSpec spec;
    spec.procedural = info.name;
    EXPECT_EQ(light_defaults(spec), info.lights) << info.name;
  }
  SceneSpec file;
  file.gltf = "level.glb";
  EXPECT_EQ(light_defaults(file), LightDefaults());
}

TEST(LightDefaults, AreTakenWhereTheSpecNamesNone) {
  for (const SceneEntry& entry : scene_registry()) {
    const SceneDescription& info = entry.description;
    LightSpec spec = completed({}, info.lights);
    EXPECT_EQ(spec.placement, info.lights.placement);
    EXPECT_EQ(spec.radius_ratio, info.lights.radius_ratio);
    spec.placement = Placement::gltf;
    spec.radius_ratio = 5;
    EXPECT_EQ(completed(spec, info.lights).placement, Placement::gltf);
    EXPECT_EQ(completed(spec, info.lights).radius_ratio, 5);
  }
  Scene grove = make_scene("grove");
  LightSpec spec, named;
  spec.count = named.count = 500;
  named.placement = Placement::area;
  named.radius_ratio = 24;
  LightSet a(spec, grove), b(named, grove);
  ASSERT_EQ(a.base().size(), b.base().size());
  for (size_t i = 0; i < a.base().size(); ++i) {
    EXPECT_EQ(a.base()[i].position, b.base()[i].position);
    EXPECT_EQ(a.base()[i].radius, b.base()[i].radius);
  }
  EXPECT_EQ(default_base_size(grove, Placement::area, 24), 0.5);
}

TEST(LightDefaults, AScriptIsTheScenesOwnWhereTheSpecNamesNone) {
  Scene plane = make_scene("plane");
  plane.light_defaults.script = LightScript::drift;
  LightSpec spec;
  spec.count = 50;
  auto moves = [&] {
    std::vector<Light> first, later;
    LightSet(spec, plane).at(0, 2, 1, first);
    LightSet(spec, plane).at(1, 2, 1, later);
    return first[0].position != later[0].position;
  };
  EXPECT_TRUE(moves());
  spec.script = LightScript::none;
  EXPECT_FALSE(moves());
}

// The file's own lights keep their positions and sizes, whatever the scene's defaults say.
TEST(LightDefaults, LeaveAFilesLightsAlone) {
  Scene plane = make_scene("plane");
  Light light;
  light.position = {1, 9, 1};
  light.radius = 6;
  plane.lights = {light};
  LightSpec spec;
  spec.placement = Placement::gltf;
  const LightSet set(spec, plane);
  ASSERT_EQ(set.base().size(), 1u);
  EXPECT_EQ(set.base()[0].radius, 6);
  EXPECT_EQ(set.base()[0].position.y, 9);
}

TEST(LoadScene, EveryListedSceneLoadsUnderItsName) {
  for (const SceneEntry& entry : scene_registry()) {
    const SceneDescription& info = entry.description;
    SceneSpec spec;
    spec.procedural = info.name;
    Scene scene = load_scene(spec);
    EXPECT_EQ(scene.name, info.name);
    EXPECT_EQ(&scene.path("default"), &scene.paths[0]);
    EXPECT_FALSE(info.summary.empty());
    try {
      scene.path("defualt");
      FAIL();
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("default"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace ml
