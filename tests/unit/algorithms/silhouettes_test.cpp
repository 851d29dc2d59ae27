// Bounds of balls in pictures of 3840x2160 and 7680x4320, square and non-square pixels, against their exact
// silhouettes in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/froxels/ball_test.h"
#include "binning_cases.h"

namespace ml {
namespace {

using namespace test;

struct Slopes {
  double low, high;
};

// Between which slopes along one axis the ball is seen, by the angles of its tangents; where one would touch
// it before the near plane, the ball's edge there.
Slopes exact_slopes(double across, double depth, double radius, double near) {
  const double distance = std::hypot(across, depth), middle = std::atan2(across, depth);
  const double behind = depth - near, chord = std::sqrt(std::max(radius * radius - behind * behind, 0.0));
  const auto end = [&](double sign) {
    if (distance > radius) {
      const double half = std::asin(radius / distance), angle = middle + sign * half;
      if (std::cos(angle) * distance * std::cos(half) >= near) return std::tan(angle);
    }
    return (across + sign * chord) / near;
  };
  return {end(-1), end(1)};
}

struct Screen {
  uint32_t width, height;
  float stretch;  // a pixel's width over its height
};
constexpr Screen screens[] = {
    {3840, 2160, 1}, {7680, 4320, 1}, {3840, 2160, 1.37f}, {7680, 4320, 0.61f}, {7680, 2160, 0.5f}};

// First and last pixel whose centre is inside the ball's silhouette, within the picture.
struct Pixels {
  double x0, x1, y0, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

Pixels pixels_inside(double x, double y, double z, double radius, const BoundsConstants& c,
                     const Screen& screen) {
  const auto near = static_cast<double>(c.view.near);
  const Slopes across = exact_slopes(x, z, radius, near), up = exact_slopes(y, z, radius, near);
  const auto pixel = [](double slope, float edge, float scale) {
    return (slope - static_cast<double>(edge)) * static_cast<double>(scale) - 0.5;
  };
  return {std::max(std::ceil(pixel(across.low, c.left_edge, c.x_pixels_per_unit)), 0.0),
          std::min(std::floor(pixel(across.high, c.left_edge, c.x_pixels_per_unit)), screen.width - 1.0),
          std::max(std::ceil(pixel(up.high, c.top_edge, c.y_pixels_per_unit)), 0.0),
          std::min(std::floor(pixel(up.low, c.top_edge, c.y_pixels_per_unit)), screen.height - 1.0)};
}

Camera camera_of(Random& random, const Screen& screen) {
  Camera camera;
  const float aspect = static_cast<float>(screen.width) / static_cast<float>(screen.height) * screen.stretch;
  camera.projection = Projection::perspective(random.uniform(0.3f, 1.8f), aspect, 0.1f, 2000);
  return camera;
}

// Mostly whole balls at some distance, of a pixel's size and larger; some reach through the near plane.
std::vector<Light> balls(Random& random, uint32_t count) {
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    const float depth = log_uniform(random, 0.2f, 1500);
    light.position = {random.uniform(-1.5f, 1.5f) * depth, random.uniform(-1, 1) * depth, -depth};
    light.radius = depth * log_uniform(random, 1e-4f, 1.5f);
  }
  return lights;
}

TEST(Silhouettes, EveryPixelCentreInsideIsInTheBoxAndHardlyAnyOther) {
  for (const Screen& screen : screens) {
    Random random(screen.width + screen.height);
    SCOPED_TRACE(testing::Message() << screen.width << "x" << screen.height << " " << screen.stretch);
    for (int round = 0; round < 10; ++round) {
      const Camera camera = camera_of(random, screen);
      BinningFrame fixture(balls(random, 2000), camera, screen.width, screen.height);
      // Tiles of one pixel: bounds to the pixel.
      const BoundsConstants c(fixture.frame.view, FroxelGrid::make(fixture.frame.view, 1, 16, 5, 0));
      VisibleLights visible;
      visible.reserve(2000);
      visible.count = scalar::cull(fixture.frame.lights, 0, 2000, c, visible);
      ASSERT_GT(visible.count, 100u);
      for (size_t i = 0; i < visible.count; ++i) {
        const FroxelBox box =
            scalar::bound_ball(c, visible.x[i], visible.y[i], visible.z[i], visible.radius[i]);
        // The camera stands at the origin and looks along -z.
        const gpu_data::LightCore& core = fixture.frame.lights.core[visible.index[i]];
        const auto x = static_cast<double>(core.position.x), y = static_cast<double>(core.position.y),
                   z = -static_cast<double>(core.position.z), r = static_cast<double>(core.radius);
        const Pixels inside = pixels_inside(x, y, z, r, c, screen);
        if (inside.empty()) continue;
        ASSERT_FALSE(box.empty()) << "light " << visible.index[i];
        ASSERT_TRUE(box.x0 <= inside.x0 && inside.x1 <= box.x1 && box.y0 <= inside.y0 && inside.y1 <= box.y1)
            << "light " << visible.index[i];
        // Where a ball is seen at a grazing angle, what its radius is widened by becomes many pixels.
        const double wide = r * (1 + 4 * (static_cast<double>(widen_relative) - 1)) + 1e-5 * z;
        const Pixels about = pixels_inside(x, y, z, wide, c, screen);
        ASSERT_TRUE(about.x0 - 2 <= box.x0 && box.x1 <= about.x1 + 2 && about.y0 - 2 <= box.y0 &&
                    box.y1 <= about.y1 + 2)
            << "light " << visible.index[i] << " " << about.x0 - box.x0 << " " << box.x1 - about.x1 << " "
            << about.y0 - box.y0 << " " << box.y1 - about.y1 << " of " << about.x1 - about.x0;
      }
    }
  }
}

// Points just inside a ball's silhouette: the froxel of the pixel that sees one is among the light's.
TEST(Silhouettes, TheFroxelsOfPointsJustInsideAreListed) {
  for (const Screen& screen : screens) {
    Random random(screen.width * 3 + screen.height);
    SCOPED_TRACE(testing::Message() << screen.width << "x" << screen.height << " " << screen.stretch);
    const Camera camera = camera_of(random, screen);
    BinningFrame fixture(balls(random, 2000), camera, screen.width, screen.height);
    const gpu_data::ViewData& view = fixture.frame.view;
    for (int narrowing : {0, 1, 2}) {
      FroxelSettings settings;
      settings.tile = 48;
      settings.refinement = narrowing == 1;
      settings.ball_test = narrowing == 2;
      FroxelLists lists{"test"};
      Spans spans;
      lists.build(fixture.frame, settings, uint64_t{1} << 28, spans);
      const FroxelGrid& grid = lists.grid();
      uint32_t inside = 0;
      for (uint32_t light = 0; light < 2000; ++light) {
        const gpu_data::LightCore& core = fixture.frame.lights.core[light];
        const glm::dvec3 center(core.position);
        const glm::dvec3 ahead = glm::normalize(center);
        const glm::dvec3 side = glm::normalize(glm::cross(ahead, glm::dvec3(0.3, 1, 0.2)));
        const glm::dvec3 up = glm::cross(ahead, side);
        for (int sample = 0; sample < 20; ++sample) {
          // On the circle where rays touch the ball, and a little inside.
          const double turn = static_cast<double>(random.uniform(0, 6.2831853f));
          const double radius = static_cast<double>(core.radius) * 0.9999;
          const double lean = std::min(radius / glm::length(center), 1.0);
          const glm::dvec3 point =
              center - ahead * (radius * lean) +
              (side * std::cos(turn) + up * std::sin(turn)) * (radius * std::sqrt(1 - lean * lean));
          const double depth = -point.z;
          if (depth < static_cast<double>(view.near)) continue;
          const auto pixel = [](double slope, float low, float high, uint32_t pixels) {
            return (slope - static_cast<double>(low)) /
                   (static_cast<double>(high) - static_cast<double>(low)) * pixels;
          };
          const double px = pixel(point.x / depth, view.left_edge, view.right_edge, screen.width);
          const double py = pixel(point.y / depth, view.top_edge, view.bottom_edge, screen.height);
          if (px < 0 || py < 0 || px >= screen.width || py >= screen.height) continue;
          const auto x = static_cast<uint32_t>(px), y = static_cast<uint32_t>(py);
          // Surfaces are seen at pixel centres.
          const glm::dvec3 seen = point_at(view, x, y, depth);
          if (glm::distance(seen, center) >= static_cast<double>(core.radius)) continue;
          ++inside;
          const uint32_t slice = gpu_data::slice_of_depth(static_cast<float>(depth), grid.mapping);
          const uint32_t cell = grid.cell(x / grid.tile, y / grid.tile, slice);
          const auto list = lists.entries().subspan(lists.offsets()[cell],
                                                    lists.offsets()[cell + 1] - lists.offsets()[cell]);
          ASSERT_TRUE(std::ranges::binary_search(list, light))
              << "light " << light << ", pixel " << x << "," << y;
        }
      }
      EXPECT_GT(inside, 1000u);
    }
  }
}

}  // namespace
}  // namespace ml
