#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/lights/law.h"
#include "level_checks.h"
#include "scenes/procedural.h"

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

// The same with every compiler: a number that changes with the generator, never with the machine.
TEST(LoadScene, ScenesAreTheSameOnEveryMachine) {
  EXPECT_EQ(hash_of(make_canyon(1)), 0xe96ff473u);
  EXPECT_EQ(hash_of(make_citadel(1)), 0xdf8c0912u);
  EXPECT_EQ(hash_of(make_grove(1)), 0x911edce2u);
  EXPECT_EQ(hash_of(make_plane()), 0xa2b6c66eu);
  EXPECT_EQ(hash_of(make_museum(1)), 0x14b9dcb8u);
  EXPECT_EQ(hash_of(make_arena(1)), 0x6db7c646u);
}

TEST(LoadScene, LightDefaultsAreKnownWithoutMakingTheScene) {
  for (const SceneInfo& info : procedural_scenes()) {
    SceneSpec spec;
    spec.procedural = info.name;
    EXPECT_EQ(light_defaults(spec), load_scene(spec).light_defaults) << info.name;
    EXPECT_EQ(light_defaults(spec), info.lights) << info.name;
  }
  SceneSpec file;
  file.gltf = "level.glb";
  EXPECT_EQ(light_defaults(file), LightDefaults());
}

TEST(LightDefaults, AreTakenWhereTheSpecNamesNone) {
  for (const SceneInfo& info : procedural_scenes()) {
    LightSpec spec = completed({}, info.lights);
    EXPECT_EQ(spec.placement, info.lights.placement);
    EXPECT_EQ(spec.radius_ratio, info.lights.radius_ratio);
    spec.placement = Placement::gltf;
    spec.radius_ratio = 5;
    EXPECT_EQ(completed(spec, info.lights).placement, Placement::gltf);
    EXPECT_EQ(completed(spec, info.lights).radius_ratio, 5);
  }
  Scene grove = make_grove(1);
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

TEST(LoadScene, EveryListedSceneLoadsUnderItsName) {
  for (const SceneInfo& info : procedural_scenes()) {
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
