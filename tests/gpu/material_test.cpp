// What the g-buffer holds of vertex colours, textures other than base colours, samplers, and surfaces that
// give light by themselves; and that the last come into every algorithm's picture once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/accuracy/image_metrics.h"
#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

class Materials : public DeviceTest {
 protected:
  // Four floats a pixel.
  struct View {
    std::vector<float> normal, albedo, material, emission;
    static glm::dvec3 three(const std::vector<float>& data, size_t pixel) {
      return {data[4 * pixel], data[4 * pixel + 1], data[4 * pixel + 2]};
    }
  };
  // A picture of `side` x `side` px of what lies in -1..1 at z = 0, seen from +z.
  static View look(const Scene& scene, const FrameOptions& options, uint32_t side, bool from_behind = false) {
    DeviceFrame frame(device(), scene, options, side, side);
    FrameInput input;
    const double eye = from_behind ? -5 : 5;
    input.view = view_data(Camera::look_at({0, 0, eye}, {0, 0, 0}, Projection::orthographic(1, 1, 0.1f, 20)),
                           side, side, 0);
    frame.load(input);
    using Aov = DeviceFrame::Aov;
    View view{frame.read_aov(Aov::normal), frame.read_aov(Aov::albedo), frame.read_aov(Aov::material), {}};
    if (options.effects.emission) view.emission = frame.read_aov(Aov::emission);
    return view;
  }
};

const FrameOptions detailed{.effects = {.material_detail = true}};

Texture texel(uint8_t r, uint8_t g, uint8_t b) {
  return {"texel", 1, 1, {r, g, b, 255}};
}

// One square in -1..1 that faces +z; u grows along +x and v along -y, as a picture lies.
Scene square(const Material& material, std::vector<Texture> textures) {
  HandMadeScene made;
  for (const Texture& texture : textures) made.texture(texture);
  made.rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, made.material(material));
  Scene scene = made.finish();
  for (Vertex& vertex : scene.vertices)
    vertex.uv = {0.5f * (vertex.position.x + 1), 0.5f * (1 - vertex.position.y)};
  return scene;
}

TEST_F(Materials, VertexColorsMultiplyTheBaseColor) {
  Material material;
  material.base_color = {0.5f, 1, 1, 1};
  material.alpha_mode = AlphaMode::mask;
  Scene scene = square(material, {});
  EXPECT_FALSE(content::has_material_detail({scene, {}, CameraPath()}));
  for (const Vertex& vertex : scene.vertices)
    scene.details.colors.emplace_back(1, vertex.position.x > 0 ? 1 : 0, 0.25f, vertex.position.y > 0 ? 1 : 0);
  EXPECT_TRUE(content::has_material_detail({scene, {}, CameraPath()}));
  constexpr uint32_t side = 16;
  FrameOptions options = detailed;
  options.effects.alpha_mask = true;
  const View view = look(scene, options, side), off = look(scene, {.effects = {.alpha_mask = true}}, side);
  for (uint32_t x = 0; x < side; ++x) {
    const size_t top = x, bottom = size_t{side - 1} * side + x;
    EXPECT_NEAR(View::three(view.albedo, top).x, 0.5, 0.005);
    EXPECT_NEAR(View::three(view.albedo, top).y, (x + 0.5) / side, 0.008) << x;
    EXPECT_NEAR(View::three(view.albedo, top).z, 0.25, 0.005);
    EXPECT_EQ(view.albedo[4 * bottom + 3], 0) << "alpha below the cutoff is cut out";
    EXPECT_GT(off.albedo[4 * bottom + 3], 0);
    EXPECT_NEAR(View::three(off.albedo, top).y, 1, 0.005) << "forced off";
  }
}

TEST_F(Materials, MetallicRoughnessTexturesMultiplyTheFactors) {
  Material material;
  material.roughness = 0.5f;
  material.metallic = 0.8f;
  // Data, not colours: 128 is a half, not 0.216.
  material.metallic_roughness_texture = 0;
  const View view = look(square(material, {texel(7, 128, 51)}), detailed, 8);
  EXPECT_NEAR(View::three(view.material, 9).x, 0.5 * 128 / 255, 0.003);
  EXPECT_NEAR(View::three(view.material, 9).y, 0.8 * 51 / 255, 0.003);
}

TEST_F(Materials, NormalMapsPointRightUpAndTowardsTheViewer) {
  Material material;
  material.normal_texture = 0;
  material.double_sided = true;
  const double half = 180.0 / 255 * 2 - 1, rest = std::sqrt(1 - 2 * half * half);
  const auto z = static_cast<uint8_t>(std::lround((rest + 1) / 2 * 255));
  for (const bool given : {false, true})
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(testing::Message() << "tangents " << given << ", mirrored " << mirrored);
      Scene scene = square(material, {texel(180, 180, z)});
      for (Vertex& vertex : scene.vertices) {
        if (mirrored) vertex.uv.x = 1 - vertex.uv.x;
        if (given) scene.details.tangents.emplace_back(mirrored ? -1 : 1, 0, 0, mirrored ? -1 : 1);
      }
      const glm::dvec3 expected(mirrored ? -half : half, half, rest);
      const View front = look(scene, detailed, 8), back = look(scene, detailed, 8, true);
      EXPECT_LT(glm::length(View::three(front.normal, 27) - expected), 0.006);
      EXPECT_LT(glm::length(View::three(back.normal, 27) + expected), 0.006) << "from behind all of it turns";
      EXPECT_LT(glm::length(View::three(look(scene, {}, 8).normal, 27) - glm::dvec3(0, 0, 1)), 1e-6);
      // The scale bends it, 0 leaves the surface flat.
      scene.materials[1].normal_scale = 0.5f;
      const glm::dvec3 less = glm::normalize(glm::dvec3(expected.x / 2, expected.y / 2, expected.z));
      EXPECT_LT(glm::length(View::three(look(scene, detailed, 8).normal, 27) - less), 0.006);
    }
  Scene without_area = square(material, {texel(180, 180, z)});
  for (Vertex& vertex : without_area.vertices) vertex.uv = {0.5f, 0.5f};
  EXPECT_LT(glm::length(View::three(look(without_area, detailed, 8).normal, 27) - glm::dvec3(0, 0, 1)), 1e-6);
}

TEST_F(Materials, EveryTextureIsReadWhereItsOwnCoordinatesSay) {
  const Texture halves{"halves", 2, 1, {255, 255, 255, 255, 0, 0, 0, 255}, {.magnify = Filter::nearest}};
  Material material;
  material.metallic = material.roughness = 1;
  material.base_color_texture = material.metallic_roughness_texture = 0;
  material.emission = {1, 1, 1};
  material.emission_texture = 0;
  Scene scene = square(material, {halves});
  for (Vertex& vertex : scene.vertices) {
    vertex.uv = {0.25f, 0};
    scene.details.metallic_roughness_uv.emplace_back(0.75f, 0);
    scene.details.emission_uv.emplace_back(0.5f * (vertex.position.x + 1), 0);
  }
  FrameOptions options = detailed;
  options.effects.emission = true;
  const View view = look(scene, options, 8);
  EXPECT_NEAR(View::three(view.albedo, 0).x, 1, 0.005);
  EXPECT_EQ(View::three(view.material, 0), glm::dvec3(0));
  EXPECT_EQ(View::three(view.emission, 0), glm::dvec3(1));
  EXPECT_EQ(View::three(view.emission, 7), glm::dvec3(0));
}

TEST_F(Materials, SamplersAreAsTheSceneHasThem) {
  Texture texture{"black and white", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  Material material;
  material.base_color_texture = 0;
  constexpr uint32_t side = 32;
  auto row = [&](const Sampler& sampler, float scale) {
    texture.sampler = sampler;
    Scene scene = square(material, {texture});
    for (Vertex& vertex : scene.vertices) vertex.uv *= scale;
    const View view = look(scene, {}, side);
    std::vector<double> values;
    for (size_t x = 0; x < side; ++x) values.push_back(View::three(view.albedo, x).x);
    return values;
  };
  const std::vector<double> nearest = row({.magnify = Filter::nearest}, 1), linear = row({}, 1);
  for (size_t x = 0; x < side; ++x) EXPECT_EQ(nearest[x], x < side / 2 ? 0.0 : 1.0) << x;
  EXPECT_NEAR(linear[side / 2], 0.5, 0.05);
  // Beyond the edge: again, mirrored, or as the edge is.
  const Filter n = Filter::nearest;
  const std::vector<double> repeat = row({.magnify = n}, 2),
                            mirror = row({.magnify = n, .u = Wrap::mirrored_repeat}, 2),
                            clamp = row({.magnify = n, .u = Wrap::clamp_to_edge}, 2);
  EXPECT_EQ(repeat[side / 2], 0.0);
  EXPECT_EQ(mirror[side / 2], 1.0);
  EXPECT_EQ(mirror[side - 1], 0.0);
  EXPECT_EQ(clamp[side - 1], 1.0);
}

TEST_F(Materials, SmallerPicturesAreMeansOfLight) {
  // Black and white in turn, far more of them than pixels.
  Texture stripes{"stripes", 1024, 1, {}};
  for (uint32_t i = 0; i < stripes.width; ++i) {
    const auto value = static_cast<uint8_t>(i % 2 ? 255 : 0);
    stripes.rgba.insert(stripes.rgba.end(), {value, value, value, 255});
  }
  Material material;
  material.base_color_texture = 0;
  for (const MipFilter mip : {MipFilter::none, MipFilter::nearest, MipFilter::linear}) {
    stripes.sampler = {.magnify = Filter::nearest, .minify = Filter::nearest, .mip = mip};
    const View view = look(square(material, {stripes}), {}, 16);
    for (size_t x = 0; x < 16; ++x) {
      const double value = View::three(view.albedo, x).x;
      if (mip == MipFilter::none)
        EXPECT_TRUE(value == 0 || value == 1) << value;
      else
        EXPECT_NEAR(value, 0.5, 0.01) << "half the light, not the light of half the byte";
    }
  }
}

// A yard with a glowing wall, a lamp of each kind of material detail, and one that is lit forward.
Scene glowing_yard() {
  Scene scene = yard();
  Material glow = scene.materials[0];
  glow.emission = {3, 0.5f, 0};
  Material forward = glow;
  forward.forward = true;
  forward.metallic_roughness_texture = 0;
  scene.textures.push_back(texel(0, 128, 200));
  scene.materials.insert(scene.materials.end(), {glow, forward});
  const auto first = static_cast<uint32_t>(scene.materials.size()) - 2;
  // Box by box, of 12 triangles each.
  std::vector<Draw> draws;
  for (const Draw& draw : scene.draws)
    for (uint32_t i = 0; i < draw.index_count; i += 36) {
      const auto kind = static_cast<uint32_t>(draws.size() % 3);
      draws.push_back({draw.first_index + i, std::min(36u, draw.index_count - i),
                       kind == 0 ? draw.material : first + kind - 1});
    }
  scene.draws = draws;
  for (size_t i = 0; i < scene.vertices.size(); ++i)
    scene.details.colors.emplace_back(1, 0.25f + 0.5f * static_cast<float>(i % 2), 1, 1);
  return scene;
}

TEST_F(Materials, EmissionComesOnTopOfEveryAlgorithmsLightOnceAndCountsNothing) {
  constexpr uint32_t width = 93, height = 61;
  const Scene scene = glowing_yard();
  ASSERT_TRUE(content::has_emission({scene, {}, CameraPath()}) &&
              content::has_material_detail({scene, {}, CameraPath()}) &&
              content::has_forward_materials({scene, {}, CameraPath()}));
  const Camera camera = camera_at({-3, 5, 22}, {-2, 1, 0}, width, height);
  const std::vector<Light> lights = scattered(60, {-25, 0, -20}, {25, 7, 18}, 1, 12, 3);
  FrameOptions options = all_shapes();
  options.effects.material_detail = true;
  Exactness dark(scene, width, height, options);
  const Seen plain = dark.expect_trials(camera, lights, {}, 20);
  std::vector<float> emission;
  const bool can_forward = device().limits().fragment_triangles && device().limits().fragment_stores;
  for (const bool forward : {false, true})
    for (const bool split : {false, true}) {
      SCOPED_TRACE(testing::Message() << "forward " << forward << ", split " << split);
      if (forward && !can_forward) continue;
      options.effects.emission = true;
      options.effects.forward = forward;
      options.shading.split_targets = split;
      Exactness lit(scene, width, height, options);
      const Seen seen = lit.expect_trials(
          camera, lights, forward == can_forward && split ? every_algorithm() : std::vector<Trial>{}, 20);
      if (emission.empty()) emission = lit.frame().read_aov(DeviceFrame::Aov::emission);
      EXPECT_EQ(seen.truth.count, plain.truth.count);
      EXPECT_EQ(seen.truth.hash, plain.truth.hash);
      uint64_t glowing = 0;
      for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
          const size_t pixel = size_t{y} * width + x;
          glowing += emission[4 * pixel] > 0;
          for (size_t c = 0; c < 3; ++c) {
            const auto with = static_cast<double>(seen.image.data[seen.image.pixel(x, y) + c]),
                       without = static_cast<double>(plain.image.data[plain.image.pixel(x, y) + c]),
                       own = static_cast<double>(emission[4 * pixel + c]);
            ASSERT_NEAR(with, without + own, 2e-4 * (without + own) + 1e-7) << x << ", " << y;
          }
        }
      EXPECT_GT(glowing, 100u);
    }
}

TEST_F(Materials, LevelsWithoutEmissionHaveNoPictureForIt) {
  DeviceFrame frame(device(), yard(), {}, 8, 8);
  EXPECT_FALSE(frame.targets().emission.has_value());
  EXPECT_FALSE(content::has_emission({yard(), {}, CameraPath()}));
  EXPECT_FALSE(content::has_material_detail({yard(), {}, CameraPath()}));
}

}  // namespace
}  // namespace ml::test
