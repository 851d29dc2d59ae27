// What became of every light of a level: used, dark, rejected or left out, and nothing in silence.
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

Scene with_lights(uint32_t count) {
  Scene scene = level();
  for (uint32_t i = 0; i < count; ++i) {
    Light light;
    light.position.x = i;
    light.radius = 2;
    scene.lights.push_back(light);
  }
  return scene;
}

TEST(LightAccount, ACountThatCutsIsSaid) {
  const Scene scene = with_lights(537);
  LightSpec spec = spec_of(512, Placement::gltf);
  const LightAccount cut = LightSet(spec, scene).account();
  EXPECT_EQ(cut.total, 537u);
  EXPECT_EQ(cut.used, 512u);
  EXPECT_EQ(cut.left_out, 25u);
  EXPECT_EQ(account_lines(cut),
            (std::vector<std::string>{"lights: 537 in the file, 512 used, 0 dark, 0 rejected, 25 left out",
                                      "25 of the file's 537 lights are left out by lights.count=512"}));
  spec.auto_count = true;
  const LightAccount all = LightSet(spec, scene).account();
  EXPECT_EQ(all.used, 537u);
  EXPECT_EQ(account_lines(all).size(), 1u);
  spec = spec_of(537, Placement::gltf);
  EXPECT_EQ(LightSet(spec, scene).account().left_out, 0u);
}

TEST(LightAccount, EveryLightIsCountedOnce) {
  Scene scene = with_lights(10);
  scene.lights[0].intensity = glm::vec3(0);
  scene.lights[1].intensity = glm::vec3(0), scene.lights[1].radius = 0;  // dark before anything else
  scene.lights[2].radius = 0;
  scene.lights[3].radius = -1;
  scene.lights[9].radius = -1;  // not looked at
  scene.rejected_lights["its node has scale 0"] = 3;
  const LightSet set(spec_of(9, Placement::gltf), scene);
  const LightAccount& account = set.account();
  EXPECT_EQ(account.total, 13u);
  EXPECT_EQ(account.used, set.base().size());
  EXPECT_EQ(account.used, 5u);
  EXPECT_EQ(account.dark, 2u);
  EXPECT_EQ(account.rejected(), 5u);
  EXPECT_EQ(account.left_out, 1u);
  EXPECT_EQ(account.used + account.dark + account.rejected() + account.left_out, account.total);
  EXPECT_EQ(account_lines(account)[0],
            "lights: 13 in the file, 5 used, 2 dark, 5 rejected (its node has scale 0: 3, radius is 0: 1, "
            "radius is negative: 1), 1 left out");
}

TEST(LightAccount, PlacedLightsAreMade) {
  const LightSet set(spec_of(100), level());
  EXPECT_FALSE(set.account().of_file);
  EXPECT_EQ(account_lines(set.account()),
            std::vector<std::string>{"lights: 100 made, 100 used, 0 dark, 0 rejected, 0 left out"});
}

TEST(LightAccount, AFileWithoutUsableLightsSaysWhatItHas) {
  Scene scene = level();
  scene.rejected_lights["directional (a sun), which has no radius"] = 1;
  try {
    LightSet(spec_of(1, Placement::gltf), scene);
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("1 directional (a sun), which has no radius"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ml
