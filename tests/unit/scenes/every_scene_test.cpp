// What holds for every scene of the registry, and the wanted numbers of its scene.json: a new scene is tested
// without a line here.
#include <gtest/gtest.h>

#include <set>

#include "level_checks.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  const SceneDescription& description() const { return describe_scene(GetParam()); }
  const Wanted& wanted() const { return description().wanted; }
  Scene scene(uint32_t seed = 1) const { return make_scene(GetParam(), seed); }
};

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& instance) { return instance.param; });

constexpr uint32_t kFrames = 120;

double depth_p95(const Scene& scene, const RayCaster& rays, const CameraPath& path, uint32_t frame,
                 uint32_t frames) {
  return probe(rays, path.sample(frame, frames, 64, 36, scene.near, scene.far)).quantile(0.95);
}

TEST_P(EveryScene, IsTheSameTwiceAndOnEveryMachine) {
  EXPECT_EQ(hash_of(scene()), wanted().hash) << std::hex << hash_of(scene());
  EXPECT_EQ(hash_of(scene(2)) != wanted().hash, wanted().differs_by_seed);
}

TEST_P(EveryScene, HasWhatItsDescriptionSays) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Scene made = scene(seed);
    EXPECT_EQ(made.name, GetParam());
    EXPECT_EQ(made.origin, glm::dvec3(0));
    EXPECT_EQ(made.near, description().near);
    EXPECT_EQ(made.far, description().far);
    EXPECT_EQ(made.light_defaults, description().lights);
    ASSERT_EQ(made.paths.size(), description().paths.size());
    for (size_t i = 0; i < made.paths.size(); ++i) {
      EXPECT_EQ(made.paths[i].name, description().paths[i].name);
      EXPECT_EQ(made.paths[i].keys.size(), description().paths[i].keys.size());
    }
    expect_in(wanted().triangles, made.triangle_count(), "triangles");
    expect_in(wanted().size_x, made.bounds.size().x, "size_x");
    expect_in(wanted().size_y, made.bounds.size().y, "size_y");
    expect_in(wanted().size_z, made.bounds.size().z, "size_z");
  }
}

TEST_P(EveryScene, HasTheMaterialsThatItsDescriptionWants) {
  const Scene made = scene();
  std::set<float> roughnesses;
  std::set<uint32_t> metals;
  for (const Draw& draw : made.draws) {
    roughnesses.insert(made.materials[draw.material].roughness);
    if (made.materials[draw.material].metallic == 1) metals.insert(draw.material);
  }
  expect_in(wanted().roughnesses, static_cast<double>(roughnesses.size()), "roughnesses");
  expect_in(wanted().metals, static_cast<double>(metals.size()), "metals");
}

TEST_P(EveryScene, IsWeldedAndEveryTriangleIsSound) {
  for (uint32_t seed : {1u, 7u}) expect_sound(scene(seed));
}

TEST_P(EveryScene, TheCameraIsNeverInAnythingNorCloseToIt) {
  for (uint32_t seed : {1u, 2u, 3u}) {
    const Scene made = scene(seed);
    const RayCaster rays(made);
    for (const auto& [name, depth] : wanted().median_depth) made.path(name);
    for (const CameraPath& path : made.paths) {
      SCOPED_TRACE(path.name + ", seed " + std::to_string(seed));
      const auto wanted_depth = wanted().median_depth.find(path.name);
      expect_free_camera(made, rays, path, path.keys.size() == 1 ? 1 : 4 * kFrames,
                         wanted_depth == wanted().median_depth.end() ? Range() : wanted_depth->second);
    }
  }
}

TEST_P(EveryScene, ViewsAreAsLongAndAsShortAsWanted) {
  if (wanted().views.empty() && wanted().frames.empty()) return;
  for (uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Scene made = scene(seed);
    const RayCaster rays(made);
    for (const WantedView& view : wanted().views) {
      const CameraPath& path = made.path(view.path);
      // 60 frames a second, one of which is at the time.
      const auto last = static_cast<uint32_t>(std::lround(path.duration() * 60));
      const auto frame = static_cast<uint32_t>(std::lround((view.time - path.keys.front().time) * 60));
      ASSERT_LE(frame, last) << view.name << " is after the path's end";
      expect_in(view.depth_p95, depth_p95(made, rays, path, frame, last + 1), view.name);
    }
    for (const WantedFrames& frames : wanted().frames) {
      double within = 0;
      for (uint32_t frame = 0; frame < kFrames; ++frame)
        within += frames.depth_p95.holds(depth_p95(made, rays, made.path(frames.path), frame, kFrames));
      expect_in(frames.share, within / kFrames, "share of frames of path " + frames.path);
    }
  }
}

TEST_P(EveryScene, LightsArePerPointAsManyAsWanted) {
  if (wanted().lights.empty()) return;
  const Scene made = scene();
  const RayCaster rays(made);
  for (const WantedLights& lights : wanted().lights) {
    SCOPED_TRACE(std::to_string(lights.count) + " lights");
    double mean = 0;
    uint32_t max = 0;
    for (uint32_t seed = 1; seed <= lights.seeds; ++seed) {
      LightSpec spec;
      spec.count = lights.count;
      spec.placement = lights.placement;
      spec.seed = seed;
      const LightSet set(spec, made);
      expect_in(lights.base_size, set.base_size(), "base_size");
      for (const Light& light : set.base()) expect_in(lights.radius, light.radius, "radius");
      const LightsSeen seen = lights_seen(made, rays, made.paths[0], set);
      mean += seen.mean / lights.seeds;
      max = std::max(max, seen.max);
    }
    expect_in(lights.mean, mean, "mean");
    expect_in(lights.max, max, "most");
  }
}

}  // namespace
}  // namespace ml
