// Lists built on the second queue beside shadow maps, or in the same way on the one queue that there is: the
// same lists, the same picture, nothing lost.
#include <gtest/gtest.h>

#include "harness/accuracy/image_metrics.h"
#include "harness/bench/case_pictures.h"
#include "harness/frame/shadow_views.h"
#include "tests/hard_cases/hard_cases.h"
#include "tests/hard_cases/pruned_check.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 101, height = 67;

class ComputeLists : public DeviceTest {};
class ShadowMapLoad : public DeviceTest {};

// The yard; every third of its materials is lit forward.
Scene mixed_yard() {
  Scene scene = yard();
  Material forward;
  forward.base_color = {0.3f, 0.6f, 0.9f, 1};
  forward.roughness = 0.3f;
  forward.forward = true;
  scene.materials.push_back(forward);
  for (size_t i = 0; i < scene.draws.size(); i += 3)
    scene.draws[i].material = static_cast<uint32_t>(scene.materials.size() - 1);
  return scene;
}

FrameOptions options_of(bool compute, uint32_t maps, bool split, bool forward) {
  FrameOptions options = all_shapes();
  options.shading.split_targets = split;
  options.effects.forward = forward;
  options.shading.shadow_maps = maps;
  options.shading.shadow_map_size = 64;
  options.shading.compute_lists = compute;
  return options;
}

Camera camera() {
  return camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
}

std::vector<Light> lights() {
  return mixed_shapes(150, {-25, 0, -20}, {25, 7, 18}, 1, 12, 5);
}

std::vector<PrunedSettings> every_way() {
  return {{}, {.caps = "exact", .prune = "coarse", .walk = "pixel"}, {.caps = "paper"}};
}

bool same(const PixelCounts& a, const PixelCounts& b) {
  return a.listed == b.listed && a.tested == b.tested && a.contributing == b.contributing &&
         a.nodes == b.nodes && a.hash == b.hash && a.traversal == b.traversal;
}

TEST_F(ComputeLists, AreThoseOfTheGraphicsQueueInEveryCombination) {
  for (bool forward : {false, true})
    for (bool split : {false, true}) {
      if (forward && !lights_forward_materials()) continue;
      SCOPED_TRACE(testing::Message() << (forward ? "forward " : "") << (split ? "split" : "one"));
      PrunedCheck plain(mixed_yard(), width, height, options_of(false, 0, split, forward));
      plain.load(camera(), lights());
      std::vector<PrunedRun> expected;
      for (const PrunedSettings& settings : every_way()) expected.push_back(plain.run(settings));
      for (bool compute : {false, true})
        for (uint32_t maps : {0u, 3u}) {
          if (!compute && maps == 0) continue;
          SCOPED_TRACE(testing::Message() << (compute ? "compute, " : "graphics, ") << maps << " maps");
          PrunedCheck check(mixed_yard(), width, height, options_of(compute, maps, split, forward));
          check.load(camera(), lights());
          for (size_t i = 0; i < expected.size(); ++i) {
            SCOPED_TRACE(every_way()[i].text());
            const PrunedRun run = check.run(every_way()[i]);
            EXPECT_TRUE(same(run.counts, expected[i].counts));
            EXPECT_EQ(compare_images(run.image, expected[i].image).differing_bits, 0u);
            EXPECT_EQ(run.frame.lost, expected[i].frame.lost);
            if (every_way()[i].caps == "exact") {
              EXPECT_EQ(run.frame.mismatched_pixels + run.frame.lost, 0u);
            }
            EXPECT_EQ(run.frame.prepare.list_bytes, expected[i].frame.prepare.list_bytes);
            EXPECT_EQ(run.frame.prepare.coarse_lights, expected[i].frame.prepare.coarse_lights);
            EXPECT_EQ(run.frame.prepare.fine_lights, expected[i].frame.prepare.fine_lights);
          }
        }
    }
}

TEST_F(ComputeLists, ChangeNothingForAnyAlgorithm) {
  Exactness beside(yard(), width, height, options_of(true, 2, false, false));
  const Seen seen = beside.expect_trials(camera(), lights(), every_algorithm(), 10);
  Exactness plain(yard(), width, height, options_of(false, 0, false, false));
  const Seen expected = plain.expect_trials(camera(), lights(), every_algorithm(), 0);
  EXPECT_EQ(compare_images(seen.image, expected.image).differing_bits, 0u);
  ASSERT_EQ(seen.counts.size(), expected.counts.size());
  for (size_t i = 0; i < seen.counts.size(); ++i) EXPECT_TRUE(same(seen.counts[i], expected.counts[i]));
}

TEST_F(ComputeLists, FollowLightsAndCameraFromFrameToFrame) {
  // Buffers grow, images have just been read or drawn, and the last frame's semaphores are used again.
  PrunedCheck check(yard(), width, height, options_of(true, 2, false, false));
  for (uint32_t count : {3u, 400u, 0u, 60u}) {
    SCOPED_TRACE(count);
    check.load(camera_at({-3 + 0.1 * count, 5, 22}, {-2, 1, 0}, width, height),
               mixed_shapes(count, {-25, 0, -20}, {25, 7, 18}, 1, 12, count));
    check.frame().read_floats(check.frame().targets().depth);
    check.expect_lossless({{}});
  }
}

TEST_F(ComputeLists, SpansOfBothSidesAreThereAndInOrder) {
  if (device().limits().second_timestamp_valid_bits == 0)
    GTEST_SKIP() << "the second queue has no timestamps";
  for (bool compute : {false, true}) {
    PrunedCheck check(yard(), width, height, options_of(compute, 2, false, false));
    check.load(camera(), lights());
    ShadedAlgorithm& algorithm = check.algorithm({});
    Spans spans;
    algorithm.prepare(check.input(), spans, check.frame().occupied_blocks().positions());
    const gpu::SubmissionTimes times = algorithm.shade(check.frame(), check.input(), gpu::Timing::stages);
    EXPECT_EQ(times.forked, compute);
    std::map<std::string, gpu::SubmissionTimes::Interval> by_name;
    for (const auto& interval : times.intervals) by_name[interval.name] = interval;
    for (const char* name : {"bounds", "coarse", "lists", "shadow_maps", "shade"})
      ASSERT_TRUE(by_name.contains(name)) << name;
    for (const char* name : {"bounds", "coarse", "lists"})
      EXPECT_EQ(by_name[name].second_queue, compute) << name;
    EXPECT_FALSE(by_name["shadow_maps"].second_queue);
    EXPECT_GE(by_name["shade"].begin, by_name["lists"].end);
    EXPECT_EQ(times.disorder, 0.0);
    if (!compute || device().info().second_queue == gpu::SecondQueue::none) {
      EXPECT_EQ(times.both_queues, 0.0);
    }
    EXPECT_LE(times.both_queues, by_name["shadow_maps"].end - by_name["shadow_maps"].begin);
  }
}

TEST_F(ShadowMapLoad, NoneAreMadeWithoutTheEffect) {
  PrunedCheck none(yard(), 32, 32, options_of(true, 0, false, false));
  EXPECT_EQ(none.frame().shadow_maps(), nullptr);
  EXPECT_EQ(none.frame().shadow_map_bytes(), 0u);
  PrunedCheck four(yard(), 32, 32, options_of(false, 4, false, false));
  EXPECT_EQ(four.frame().shadow_map_bytes(), 4u * 64 * 64 * 4);
}

TEST_F(ShadowMapLoad, MapsShowTheLevelFromTheLargestLights) {
  HandMadeScene made;
  Texture holes;
  holes.name = "holes";
  holes.width = holes.height = 1;
  holes.rgba = {255, 255, 255, 0};
  Material cut;
  cut.base_color_texture = static_cast<int>(made.texture(holes));
  cut.alpha_mode = AlphaMode::mask;
  const uint32_t hole = made.material(cut);
  made.rectangle({-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
  // A sheet that is all hole, 1 m below the omni light.
  made.rectangle({-9, 3, 9}, {18, 0, 0}, {0, 0, -18}, hole);
  made.box({-22, 0, -2}, {-18, 1, 2});
  FrameOptions options = options_of(false, 3, false, false);
  options.effects.alpha_mask = true;
  PrunedCheck check(made.finish(), 48, 48, options);
  std::vector<Light> two{omni({0, 4, 0}, 9), spot({-20, 8, 0}, 12, {0, -1, 0}, 20, 30), omni({3, 2, 1}, 1)};
  check.load(camera_at({0, 6, 20}, {0, 0, 0}, 48, 48), two);
  Spans spans;
  check.algorithm({}).prepare(check.input(), spans, check.frame().occupied_blocks().positions());
  check.algorithm({}).shade(check.frame(), check.input(), gpu::Timing::none);
  ASSERT_EQ(check.frame().shadow_maps()->maps().size(), 3u);
  auto nearest = [&](size_t map, uint32_t x, uint32_t y) {
    const std::vector<float> depth = check.frame().read_floats(check.frame().shadow_maps()->maps()[map]);
    return 0.05f / depth[y * 64 + x];
  };
  EXPECT_NEAR(nearest(0, 32, 32), 7, 1e-3) << "the spot's: the top of the box below it";
  EXPECT_NEAR(nearest(0, 2, 2), 8, 1e-3) << "and the floor beside";
  EXPECT_NEAR(nearest(1, 32, 32), 4, 1e-3) << "the omni's: the floor through the hole";
  EXPECT_NEAR(nearest(2, 32, 32), 2, 1e-3) << "the smallest one's";
}

TEST(ShadowViews, TakeTheLargestLightsThatCastShadows) {
  Light probe = omni({0, 9, 0}, 50);
  probe.probe = true;
  const std::vector<Light> list{omni({1, 2, 3}, 2), probe, spot({4, 5, 6}, 7, {1, 0, 0}, 10, 20),
                                omni({7, 8, 9}, 2)};
  FrameLightStorage storage;
  const Camera camera = camera_at({10, 20, 30}, {0, 0, 0}, 16, 16);
  storage.fill(list, camera.position);
  FrameInput input;
  input.view = view_data(camera, 16, 16, 4);
  input.lights = storage.lights();
  const auto views = shadow_views(input, 5, 256);
  ASSERT_EQ(views.size(), 5u);
  const std::vector<glm::vec3> positions{{4, 5, 6}, {1, 2, 3}, {7, 8, 9}, {4, 5, 6}, {1, 2, 3}};
  for (size_t i = 0; i < views.size(); ++i) {
    EXPECT_LT(glm::distance(views[i].camera, positions[i]), 1e-4f) << i;
    EXPECT_EQ(views[i].resolution, glm::uvec2(256));
  }
  EXPECT_LT(glm::distance(views[0].forward, glm::vec3(1, 0, 0)), 1e-6f);
  EXPECT_NEAR(views[0].right_edge, std::tan(20 * degrees), 1e-5f);
  EXPECT_LT(glm::distance(views[1].forward, glm::vec3(0, -1, 0)), 1e-6f);
  EXPECT_NEAR(views[1].right_edge, 1, 1e-6f);
  EXPECT_GT(glm::distance(views[4].forward, views[1].forward), 0.5f) << "another round, another axis";

  storage.fill({}, camera.position);
  input.lights = storage.lights();
  EXPECT_EQ(shadow_views(input, 16, 64).size(), 16u);
}

}  // namespace
}  // namespace ml::test
