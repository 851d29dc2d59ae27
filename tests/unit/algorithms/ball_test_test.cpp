// The ball test against the distance of a ball from a froxel, found in double precision by halving: it never
// leaves out what the ball reaches, and hardly anything else stays.
#include "algorithms/froxels/ball_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "binning_cases.h"

namespace ml {
namespace {

using namespace test;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Froxel {
  double left, right, bottom, top, near, far;
};

// Of the pixel centres of a cell, not widened.
Froxel froxel_of(const BoundsConstants& c, const std::vector<FroxelGrid::DepthRange>& slices, uint32_t column,
                 uint32_t row, uint32_t slice) {
  const auto window = [](uint32_t pixel, float edge, float scale) {
    return static_cast<double>(edge) + (pixel + 0.5) / static_cast<double>(scale);
  };
  const uint32_t tile = c.grid.tile;
  const uint32_t x1 = std::min((column + 1) * tile, c.view.resolution.x) - 1,
                 y1 = std::min((row + 1) * tile, c.view.resolution.y) - 1;
  return {window(column * tile, c.left_edge, c.x_pixels_per_unit),
          window(x1, c.left_edge, c.x_pixels_per_unit),
          window(y1, c.top_edge, c.y_pixels_per_unit),
          window(row * tile, c.top_edge, c.y_pixels_per_unit),
          static_cast<double>(std::max(slices[slice].low, c.view.near)),
          static_cast<double>(slices[slice].high)};
}

double distance_at(const Froxel& f, bool orthographic, glm::dvec3 at, double depth) {
  const double scale = orthographic ? 1 : depth;
  const double x = std::max({f.left * scale - at.x, at.x - f.right * scale, 0.0});
  const double y = std::max({f.bottom * scale - at.y, at.y - f.top * scale, 0.0});
  return std::sqrt(x * x + y * y + (depth - at.z) * (depth - at.z));
}

double distance_from(const Froxel& f, bool orthographic, glm::dvec3 at) {
  // The nearest point is no farther away than that at the near end.
  double low = f.near, high = std::min(f.far, std::max(low, at.z + distance_at(f, orthographic, at, low)));
  if (high < low) return infinity;  // no surface has such a depth
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (distance_at(f, orthographic, at, a) < distance_at(f, orthographic, at, b) ? high : low) =
        distance_at(f, orthographic, at, a) < distance_at(f, orthographic, at, b) ? b : a;
  }
  return distance_at(f, orthographic, at, low);
}

TEST(BallTest, LeavesOutWhatTheBallMissesAndNothingElse) {
  uint64_t missed = 0, in_vain = 0, met = 0, balls = 0;
  double chords = 0;  // lengths, as parts of the balls' diameters
  for (uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Camera camera = random_camera(random);
    BinningFrame fixture(random_lights(random, 60, camera), camera, 1 + random.below(400),
                         1 + random.below(400));
    const FroxelSettings s = random_settings(random);
    const BoundsConstants constants(fixture.frame.view,
                                    FroxelGrid::make(fixture.frame.view, s.tile, s.slices, s.zmin, s.zmax));
    const FroxelGrid& grid = constants.grid;
    const bool orthographic = constants.view.orthographic != 0;
    VisibleLights visible;
    visible.reserve(60);
    visible.count = scalar::cull(fixture.frame.lights, 0, 60, constants, visible);
    BallTest test;
    test.build(constants);
    std::vector<FroxelGrid::DepthRange> slices;
    grid.slice_ranges(slices);
    for (size_t i = 0; i < visible.count; ++i) {
      const glm::dvec3 at(visible.x[i], visible.y[i], visible.z[i]);
      // The ball as it was before it was widened.
      const auto radius = static_cast<double>(fixture.frame.lights.radius[visible.index[i]]);
      const FroxelBox box =
          scalar::bound_ball(constants, visible.x[i], visible.y[i], visible.z[i], visible.radius[i]);
      for (int sample = 0; sample < 60 && !box.empty(); ++sample) {
        const uint32_t column = box.x0 + random.below(box.x1 - box.x0 + 1u),
                       row = box.y0 + random.below(box.y1 - box.y0 + 1u),
                       slice = box.z0 + random.below(box.z1 - box.z0 + 1u);
        const double distance =
            distance_from(froxel_of(constants, slices, column, row, slice), orthographic, at);
        if (std::isinf(distance)) continue;
        const auto [reached, between] =
            scalar::ball_in_froxel(test, orthographic, visible.x[i], visible.y[i], visible.z[i],
                                   visible.radius[i], column, row, slice);
        ASSERT_TRUE(reached || distance > radius)
            << "light " << visible.index[i] << ", froxel " << column << " " << row << " " << slice;
        const bool clearly = distance > radius * 1.01 + 1e-3 * glm::length(at);
        missed += clearly;
        in_vain += clearly && reached;
        // The ball's depths in the tile, of which the froxel's are a part.
        const Froxel froxel = froxel_of(constants, slices, column, row, slice);
        for (int k = 0; k < 8; ++k) {
          const double depth = at.z + radius * random.uniform(-1, 1);
          if (depth < static_cast<double>(constants.view.near) ||
              distance_at(froxel, orthographic, at, depth) > radius)
            continue;
          ++met;
          ASSERT_TRUE(-static_cast<double>(between.minus_low) <= depth &&
                      depth <= static_cast<double>(between.high))
              << depth << " is not between " << -between.minus_low << " and " << between.high;
        }
        if (reached) {
          chords += static_cast<double>(between.minus_low + between.high) / (2 * radius);
          ++balls;
        }
      }
    }
  }
  EXPECT_GT(met, 100000u);
  RecordProperty("mean_chord", std::to_string(chords / static_cast<double>(balls)));
  EXPECT_LT(chords, 0.95 * static_cast<double>(balls));
  EXPECT_GT(missed, 10000u);
  EXPECT_LT(in_vain * 200, missed) << "of " << missed;
}

}  // namespace
}  // namespace ml
