// Diffuse and specular light in targets of their own, put together by a composite pass.
#include <gtest/gtest.h>

#include "harness/accuracy/image_metrics.h"
#include "harness/bench/case_pictures.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {
namespace {

constexpr uint32_t width = 117, height = 71;
// Sums of products in another order: far below what tells algorithms apart.
constexpr double rounding = 1e-5;

class SplitTargets : public DeviceTest {};

FrameOptions targets(bool split, bool forward = false) {
  FrameOptions options = all_shapes();
  options.effects.forward = forward;
  options.shading.split_targets = split;
  return options;
}

// The yard with every kind of material on its boxes: metal and not, smooth and rough, black and white.
Scene materials_yard(float brightness = 1) {
  Scene scene = yard();
  scene.materials.clear();
  for (float metallic : {0.0f, 0.4f, 1.0f})
    for (float roughness : {0.0f, 0.3f, 0.9f}) {
      Material material;
      material.base_color = glm::vec4(glm::vec3(1.0f - metallic * 0.3f, 0.5f, roughness) * brightness, 1);
      material.metallic = metallic;
      material.roughness = roughness;
      scene.materials.push_back(material);
    }
  for (size_t i = 0; i < scene.draws.size(); ++i)
    scene.draws[i].material = static_cast<uint32_t>(i % scene.materials.size());
  return scene;
}

Camera camera() {
  return camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
}

std::vector<Light> lights() {
  return mixed_shapes(140, {-25, 0, -20}, {25, 7, 18}, 1, 12, 3);
}

TEST_F(SplitTargets, PictureIsThatOfOneTargetWithEveryAlgorithm) {
  for (bool specular : {true, false}) {
    SCOPED_TRACE(specular);
    FrameOptions both = targets(true), one = targets(false);
    both.effects.specular = one.effects.specular = specular;
    Exactness split(materials_yard(), width, height, both);
    const Seen seen =
        split.expect_trials(camera(), lights(), specular ? every_algorithm() : std::vector<Trial>{}, 40);
    Exactness whole(materials_yard(), width, height, one);
    const Seen plain = whole.expect_trials(camera(), lights(), {}, 0);
    const double floor = rounding * plain.image.data[plain.image.pixel(width / 2, height / 2)];
    const ImageDifference difference = compare_images(seen.image, plain.image, std::max(floor, 1e-6));
    EXPECT_LE(difference.max_relative, rounding);
    EXPECT_EQ(seen.truth.hash, plain.truth.hash);
  }
}

TEST_F(SplitTargets, ShadingPassKnowsNoAlbedo) {
  Exactness bright(materials_yard(1), width, height, targets(true)),
      dark(materials_yard(0.1f), width, height, targets(true));
  const Seen a = bright.expect_trials(camera(), lights(), {}, 0),
             b = dark.expect_trials(camera(), lights(), {}, 0);
  EXPECT_GT(compare_images(a.image, b.image, 1e-6).max_relative, 0.5) << "the pictures are to differ";
  for (auto target : {&FrameTargets::diffuse, &FrameTargets::specular}) {
    const std::vector<float> of_bright = bright.frame().read_floats(*(bright.frame().targets().*target)),
                             of_dark = dark.frame().read_floats(*(dark.frame().targets().*target));
    EXPECT_EQ(of_bright, of_dark);
    EXPECT_GT(*std::max_element(of_bright.begin(), of_bright.end()), 0.0f);
  }
}

TEST_F(SplitTargets, ForwardMaterialsAreLitAfterTheComposite) {
  if (!lights_forward_materials()) GTEST_SKIP() << no_forward_materials;
  Scene scene = materials_yard();
  for (size_t i = 0; i < scene.materials.size(); i += 2) scene.materials[i].forward = true;
  Exactness split(scene, width, height, targets(true, true));
  const Seen seen = split.expect_trials(camera(), lights(), every_algorithm(), 20);
  Exactness whole(scene, width, height, targets(false, false));
  const Seen plain = whole.expect_trials(camera(), lights(), {}, 0);
  EXPECT_LE(compare_images(seen.image, plain.image, 1e-6).max_relative, 1e-4);
}

TEST_F(SplitTargets, OneTargetHasNoOthers) {
  Exactness whole(materials_yard(), 32, 32, targets(false));
  EXPECT_FALSE(whole.frame().targets().diffuse.has_value());
  EXPECT_FALSE(whole.frame().targets().specular.has_value());
  Exactness split(materials_yard(), 32, 32, targets(true));
  EXPECT_EQ(split.frame().target_bytes(), whole.frame().target_bytes() + uint64_t{32} * 32 * 32);
}

}  // namespace
}  // namespace ml::test
