// What the g-buffer holds of surfaces whose position and material are known.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/random.h"
#include "scenes/scene_registry.h"
#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {
namespace {

class GBuffer : public DeviceTest {
 protected:
  // The picture of the scene, four floats a pixel.
  struct View {
    std::vector<float> position, normal, albedo, material;
    glm::dvec3 three(const std::vector<float>& data, size_t pixel) const {
      return {data[4 * pixel], data[4 * pixel + 1], data[4 * pixel + 2]};
    }
    double depth(size_t pixel) const { return static_cast<double>(position[4 * pixel + 3]); }
  };
  static View look(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height,
                   bool alpha_mask = false) {
    DeviceFrame frame(device(), scene,
                      {.effects = {.alpha_mask = alpha_mask, .clip_far = camera.projection.clips_far}}, width,
                      height);
    FrameInput input;
    input.view = view_data(camera, width, height, 0);
    frame.load(input);
    using Aov = DeviceFrame::Aov;
    return {frame.read_aov(Aov::position), frame.read_aov(Aov::normal), frame.read_aov(Aov::albedo),
            frame.read_aov(Aov::material)};
  }
};

// px that a surface may seem moved by, because its vertices are: what drivers with 4 bits show (SwiftShader).
// With 8 bits and more it is lost in the tolerances.
double moved_pixels() {
  const uint32_t bits = device().limits().subpixel_bits;
  return bits < 8 ? std::exp2(-static_cast<double>(bits) - 1) : 0;
}

// Pixel centre to direction, right-up-forward with forward 1.
glm::dvec3 ray_of(const Camera& camera, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const Projection& p = camera.projection;
  const double u = (x + 0.5) / width, v = (y + 0.5) / height;
  const double across = static_cast<double>(p.left) + u * static_cast<double>(p.right - p.left);
  const double up = static_cast<double>(p.top) + v * static_cast<double>(p.bottom - p.top);
  return glm::dvec3(camera.right) * across + glm::dvec3(camera.up) * up + glm::dvec3(camera.forward);
}

TEST_F(GBuffer, PositionsLieOnThePlane) {
  constexpr uint32_t width = 97, height = 61;
  const Scene plane = make_scene("plane");
  for (uint32_t index = 0; index < 3; ++index) {
    const Camera camera = plane.paths[0].sample(index, 3, width, height, plane.near, plane.far);
    View view = look(plane, camera, width, height);
    uint32_t lit = 0;
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const size_t pixel = size_t{y} * width + x;
        const glm::dvec3 ray = ray_of(camera, x, y, width, height);
        const double truth = -static_cast<double>(camera.position.y) / ray.y;
        const glm::dvec3 hit = glm::dvec3(camera.position) + ray * truth;
        const bool on_plane = truth > 0 && std::abs(hit.x) < 49.9 && std::abs(hit.z) < 49.9;
        ASSERT_TRUE(!on_plane || view.depth(pixel) > 0) << x << ", " << y;
        if (view.depth(pixel) == 0) {
          EXPECT_EQ(view.three(view.position, pixel), glm::dvec3(0));
          continue;
        }
        ++lit;
        // Half a row up or down moves the ray's slope by half of this; a depth is the camera's height over
        // the slope.
        const double row = static_cast<double>(camera.projection.top - camera.projection.bottom) / height;
        const double moved =
            2 * moved_pixels() * row * truth * truth / static_cast<double>(camera.position.y);
        const double tolerance = 2e-5 * (1 + truth);
        EXPECT_NEAR(view.depth(pixel), truth,
                    tolerance * (1 + truth / static_cast<double>(camera.position.y)) + moved);
        EXPECT_NEAR(view.three(view.position, pixel).y, -static_cast<double>(camera.position.y),
                    tolerance + moved * std::abs(ray.y))
            << x << ", " << y;
        EXPECT_LT(glm::length(view.three(view.normal, pixel) - glm::dvec3(0, 1, 0)), 1e-6);
        EXPECT_NEAR(view.three(view.albedo, pixel).x, 0.5, 0.004);
        EXPECT_NEAR(view.three(view.material, pixel).x, 0.6, 0.002);
        EXPECT_EQ(view.three(view.material, pixel).y, 0.0);
      }
    EXPECT_GT(lit, width * height / 4);
  }
}

// A perspective far plane cuts where the depth is, not where the distance is, and changes nothing before it.
TEST_F(GBuffer, AFarPlaneCuts) {
  constexpr uint32_t width = 64, height = 36;
  Camera camera =
      Camera::look_at({0, 3, 7}, {0, 0, 0}, Projection::perspective(0.9f, 16.0f / 9, 0.1f, 8), {0.3, 1, 0});
  const Scene scene = floor_at({0, 0, 0}, 60);
  const View whole = look(scene, camera, width, height);
  camera.projection.clips_far = true;
  const View cut = look(scene, camera, width, height);
  uint32_t near = 0, far = 0;
  for (size_t pixel = 0; pixel < size_t{width} * height; ++pixel) {
    const double depth = whole.depth(pixel);
    if (std::abs(depth - 8) < 1e-5) continue;
    EXPECT_EQ(cut.depth(pixel), depth > 8 ? 0 : depth);
    near += depth > 0 && depth < 8;
    far += depth > 8;
  }
  EXPECT_GT(near, 100u);
  EXPECT_GT(far, 100u);
}

TEST_F(GBuffer, OrthographicDepthIsLinear) {
  constexpr uint32_t width = 48, height = 32;
  const Projection projection = Projection::orthographic(6, 4, 0.5f, 90);
  const Camera camera = Camera::look_at({0, 10, 10}, {0, 0, 0}, projection);
  View view = look(floor_at({0, 0, 0}, 100), camera, width, height);
  for (size_t pixel = 0; pixel < size_t{width} * height; ++pixel) {
    ASSERT_GT(view.depth(pixel), 0.0);
    // A pixel is 0.25 m of the picture, which stands at 45 degrees to the floor.
    EXPECT_NEAR(view.three(view.position, pixel).y, -10, 1e-4 + moved_pixels() * 0.25);
  }
  // The nearer surface wins, and what lies before near or beyond far is not there.
  HandMadeScene made;
  made.rectangle({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}).rectangle({-9, 1, 9}, {18, 0, 0}, {0, 0, -18});
  made.rectangle({-9, -95, 9}, {18, 0, 0}, {0, 0, -18}).rectangle({-9, 9.9f, 9}, {18, 0, 0}, {0, 0, -18});
  View stacked = look(made.finish(), Camera::look_at({0, 10, 0}, {0, 0, 0}, projection), width, height);
  for (size_t pixel = 0; pixel < size_t{width} * height; ++pixel) ASSERT_NEAR(stacked.depth(pixel), 9, 1e-4);
}

TEST_F(GBuffer, NormalsKeepTheirDirection) {
  // Many small squares whose vertex normals point anywhere. Half a step of 2/4094 in both octahedral
  // coordinates is at most 0.0594 degrees, in the middle of a face.
  constexpr uint32_t side = 40;
  HandMadeScene made;
  for (uint32_t i = 0; i < side * side; ++i)
    made.rectangle({static_cast<float>(i % side), 0, static_cast<float>(i / side) + 1.0f}, {1, 0, 0},
                   {0, 0, -1});
  Scene scene = made.finish();
  Random random(4);
  std::vector<glm::dvec3> truth;
  for (uint32_t i = 0; i < side * side; ++i) {
    glm::vec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    // Axes, edges and corners of the octahedron too.
    if (i % 5 == 0) normal[static_cast<int>(random.below(3))] = 0;
    if (i < 6) normal = glm::vec3(i / 2 == 0, i / 2 == 1, i / 2 == 2) * (i % 2 ? 1.0f : -1.0f);
    normal = glm::length(normal) > 0.01f ? glm::normalize(normal) : glm::vec3(0, 0, -1);
    truth.push_back(normal);
    for (size_t corner = 0; corner < 4; ++corner) scene.vertices[4 * i + corner].normal = normal;
  }
  Camera camera = Camera::look_at({side / 2.0, 10, side / 2.0}, {side / 2.0, 0, side / 2.0},
                                  Projection::orthographic(side / 2.0f, side / 2.0f, 0.1f, 100));
  View view = look(scene, camera, side, side);
  // Which square a pixel shows follows from its position.
  uint32_t seen = 0;
  for (size_t pixel = 0; pixel < size_t{side} * side; ++pixel) {
    if (view.depth(pixel) == 0) continue;
    const glm::dvec3 at = glm::dvec3(camera.position) + view.three(view.position, pixel);
    const auto column = static_cast<size_t>(at.x), row = static_cast<size_t>(at.z);
    const glm::dvec3 normal = view.three(view.normal, pixel);
    ++seen;
    EXPECT_NEAR(glm::length(normal), 1, 1e-6);
    const double angle =
        std::asin(std::min(1.0, glm::length(glm::cross(normal, truth[row * side + column])))) /
        0.017453292519943295;
    EXPECT_LE(angle, 0.0595) << "pixel " << pixel;
    EXPECT_GT(glm::dot(normal, truth[row * side + column]), 0.0);
  }
  EXPECT_EQ(seen, side * side);
}

TEST_F(GBuffer, MasksTexturesAndSides) {
  constexpr uint32_t width = 64, height = 16;
  HandMadeScene made;
  // Two texels across: the left one opaque red, the right one transparent green.
  Material cut;
  cut.name = "cut";
  cut.base_color_texture = static_cast<int>(made.texture({"two", 2, 1, {255, 0, 0, 255, 0, 255, 0, 0}}));
  cut.alpha_mode = AlphaMode::mask;
  Material both;
  both.name = "both sides";
  both.double_sided = true;
  const uint32_t masked = made.material(cut), two_sided = made.material(both);
  made.rectangle({-4, -1, -5}, {2, 0, 0}, {0, 2, 0}, masked);  // masked
  made.rectangle({0, -1, -5}, {-2, 0, 0}, {0, 2, 0});          // seen from behind: not there
  made.rectangle({2, -1, -5}, {-2, 0, 0}, {0, 2, 0},
                 two_sided);                          // from behind, both sides: its normal faces the eye
  made.rectangle({2, -1, -5}, {2, 0, 0}, {0, 2, 0});  // from the front
  const Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, Projection::orthographic(4, 1, 0.1f, 20));
  const Scene scene = made.finish();
  View view = look(scene, camera, width, height, true), unmasked = look(scene, camera, width, height, false);
  auto at = [&](uint32_t x) { return size_t{height / 2} * width + x; };
  EXPECT_GT(view.depth(at(2)), 0.0) << "the opaque texel";
  EXPECT_EQ(view.depth(at(11)), 0.0) << "the transparent texel is cut out";
  EXPECT_GT(unmasked.depth(at(11)), 0.0) << "the mask was forced off";
  EXPECT_GT(view.three(view.albedo, at(4)).x, 0.9);
  EXPECT_LT(view.three(view.albedo, at(4)).y, 0.1);
  EXPECT_EQ(view.depth(at(24)), 0.0) << "a back face";
  EXPECT_GT(view.depth(at(40)), 0.0);
  EXPECT_LT(glm::length(view.three(view.normal, at(40)) - glm::dvec3(0, 0, 1)), 1e-6);
  EXPECT_GT(view.depth(at(56)), 0.0);
  EXPECT_LT(glm::length(view.three(view.normal, at(56)) - glm::dvec3(0, 0, 1)), 1e-6);
}

}  // namespace
}  // namespace ml::test
