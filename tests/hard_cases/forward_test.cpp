// Materials that are lit forward: every pixel once, with the same lights, and the same picture as without.
#include <gtest/gtest.h>

#include "harness/accuracy/image_metrics.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/verify.h"
#include "tests/hard_cases/hard_cases.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 123, height = 77;

class ForwardMaterials : public DeviceTest {};

FrameOptions with_forward(bool forward) {
  FrameOptions options = all_shapes();
  options.effects.alpha_mask = true;
  options.effects.forward = forward;
  return options;
}

Material forward_material(glm::vec3 colour) {
  Material material;
  material.base_color = glm::vec4(colour, 1);
  material.roughness = 0.25f;
  material.metallic = 0.7f;
  material.forward = true;
  return material;
}

// Two columns of 8 texels: opaque, and holes.
Texture grating() {
  Texture texture;
  texture.name = "grating";
  texture.width = 16;
  texture.height = 1;
  for (uint32_t i = 0; i < texture.width; ++i)
    texture.rgba.insert(texture.rgba.end(),
                        {static_cast<uint8_t>(255 - 10 * i), 200, 60, static_cast<uint8_t>(i % 2 ? 255 : 0)});
  return texture;
}

// All that may go wrong at equal depth: forward and deferred sheets that lie in one another, in either order,
// two forward sheets of different materials and of the same one, a sheet seen from behind, a grating, and a
// forward thing behind others.
Scene tangle() {
  HandMadeScene made;
  const uint32_t red = made.material(forward_material({0.8f, 0.2f, 0.1f})),
                 blue = made.material(forward_material({0.1f, 0.3f, 0.9f}));
  Material both = forward_material({0.2f, 0.9f, 0.3f});
  both.double_sided = true;
  const uint32_t green = made.material(both);
  Material cut = forward_material({1, 1, 1});
  cut.base_color_texture = static_cast<int>(made.texture(grating()));
  cut.alpha_mode = AlphaMode::mask;
  const uint32_t grate = made.material(cut);
  made.rectangle({-30, 0, 20}, {60, 0, 0}, {0, 0, -60});
  auto sheet = [&](float x, float z, uint32_t material) {
    made.rectangle({x, 0.5f, z}, {3, 0, 0}, {0, 3, 0}, material);
  };
  sheet(-8, 0, 0), sheet(-8, 0, red);                          // deferred first
  sheet(-4.5f, 0, red), sheet(-4.5f, 0, 0);                    // forward first
  sheet(-1, 0, red), sheet(-0.5f, 0, blue);                    // overlapping
  sheet(2.5f, 0, blue), sheet(3, 0, blue);                     // in one draw
  made.rectangle({9, 0.5f, 0}, {-3, 0, 0}, {0, 3, 0}, green);  // from behind
  made.rectangle({6, 0.5f, 0}, {3, 0, 0}, {0, 3, 0}, green);   // and its front, at the same position
  sheet(-6, 3, grate);                                         // holes before deferred and forward
  sheet(-3, -4, blue), sheet(0, -4, 0);                        // behind
  made.box({-9, 0, 4}, {-7, 1, 6}, red).box({5, 0, 3}, {7, 2, 4}, 0);
  return made.finish();
}

Camera before_it() {
  return camera_at({0.5, 3, 11}, {0, 1.5, 0}, width, height);
}

std::vector<Light> lights() {
  return mixed_shapes(160, {-10, 0, -6}, {10, 5, 8}, 1, 9, 11);
}

TEST_F(ForwardMaterials, EveryPixelIsLitOnceByEveryAlgorithmAsIfItWereDeferred) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  // brute_force, ideal and all others: counted lights are the reference's, so none is missing and none there
  // twice.
  Exactness forward(tangle(), width, height, with_forward(true));
  const Seen seen = forward.expect_trials(before_it(), lights(), every_algorithm(), 40);
  Exactness deferred(tangle(), width, height, with_forward(false));
  const Seen plain = deferred.expect_trials(before_it(), lights(), {}, 40);
  ImageDifference difference = compare_images(seen.image, plain.image, 1e-6);
  EXPECT_LE(difference.max_relative, image_tolerance);
  EXPECT_EQ(seen.truth.count, plain.truth.count);
  EXPECT_EQ(seen.truth.hash, plain.truth.hash);
}

TEST_F(ForwardMaterials, DeferredPassLeavesMarkedPixelsOutAndTheForwardPassTouchesNoOther) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  Exactness forward(tangle(), width, height, with_forward(true));
  const Seen seen = forward.expect_trials(before_it(), lights(), {}, 0);
  const std::vector<uint32_t> marks = forward.frame().read_words(*forward.frame().targets().forward);
  uint64_t marked = 0, deferred = 0;
  for (size_t i = 0; i < marks.size(); ++i) {
    marked += marks[i] != 0;
    deferred += seen.lit[i] && marks[i] == 0;
    EXPECT_TRUE(marks[i] == 0 || seen.lit[i]) << "a mark in the sky, pixel " << i;
  }
  EXPECT_GT(marked, 800u);
  EXPECT_GT(deferred, 800u);
  // Nothing but the g-buffer pass writes marks: they name triangles of forward draws only.
  const Scene scene = tangle();
  for (uint32_t mark : marks) {
    if (mark == 0) continue;
    bool found = false;
    for (const Draw& draw : scene.draws)
      found |= scene.materials[draw.material].forward && (mark - 1) * 3 >= draw.first_index &&
               (mark - 1) * 3 < draw.first_index + draw.index_count;
    ASSERT_TRUE(found) << "triangle " << mark - 1;
  }
}

TEST_F(ForwardMaterials, RunWithoutForwardMaterialsHasNoneOfIt) {
  Exactness plain(yard(), 32, 32, all_shapes());
  EXPECT_FALSE(plain.frame().targets().forward.has_value());
  EXPECT_FALSE(content::has_forward_materials({yard(), {}, CameraPath()}));
  EXPECT_TRUE(content::has_forward_materials({tangle(), {}, CameraPath()}));
}

TEST_F(ForwardMaterials, SceneThatIsForwardAltogether) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  Scene scene = yard();
  for (Material& material : scene.materials) material.forward = true;
  const Camera camera = camera_at({0, 6, 30}, {0, 1, 0}, width, height);
  const std::vector<Light> many = scattered(120, {-30, 0, -30}, {30, 6, 20}, 1, 12, 5);
  FrameOptions options{.effects = {.spots = true, .forward = true}, .many_lights = false};
  Exactness forward(scene, width, height, options);
  const Seen seen = forward.expect_exact(camera, many);
  options.effects.forward = false;
  Exactness deferred(scene, width, height, options);
  const Seen plain = deferred.expect_trials(camera, many, {}, 0);
  EXPECT_LE(compare_images(seen.image, plain.image, 1e-6).max_relative, image_tolerance);
}

TEST_F(ForwardMaterials, FarFromTheOriginInAnOrthographicPicture) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  Scene scene = yard();
  for (size_t i = 1; i < scene.materials.size(); ++i) scene.materials[i].forward = true;
  Camera camera = camera_at({4, 40, 30}, {4, 0, 0}, width, height);
  camera.projection = Projection::orthographic(24, 15, 0.1f, 120);
  Exactness forward(scene, width, height,
                    {.effects = {.spots = true, .forward = true}, .many_lights = false});
  forward.expect_exact(camera, scattered(90, {-20, 0, -20}, {25, 6, 12}, 1, 10, 6));
}

}  // namespace
}  // namespace ml::test
