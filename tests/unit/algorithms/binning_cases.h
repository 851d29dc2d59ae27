// Random cameras, lights and frames for the tests of binning and trees.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "harness/base/random.h"
#include "harness/frame/frame_input.h"

namespace ml::test {

inline float log_uniform(Random& random, float low, float high) {
  return low * std::pow(high / low, random.uniform());
}

// A camera that looks somewhere, with an off-centre window; every third is orthographic.
Camera random_camera(Random& random);
// Around the camera at all distances, in front and behind, so that many straddle the near plane or hold the
// camera.
std::vector<Light> random_lights(Random& random, uint32_t count, const Camera& camera);
FroxelSettings random_settings(Random& random);

struct BinningFrame {
  Threads threads;
  FrameLightStorage storage;
  FrameInput frame;
  BinningFrame(const std::vector<Light>& lights, const Camera& camera, uint32_t width, uint32_t height,
               unsigned count = 1);
};

// The point of the view at a pixel's centre and a depth, camera-relative, in double.
glm::dvec3 point_at(const gpu_data::ViewData& view, uint32_t x, uint32_t y, double depth);

// At `samples` random pixels and depths of a frame: expects that the lights of the pixel's cell at that
// depth, in any order, are none of them there twice, and all there inside whose ball the point lies.
using LightsAt = std::function<std::vector<uint32_t>(uint32_t cell, float depth)>;
void expect_no_light_lost(Random& random, const FrameInput& frame, const FroxelGrid& grid, uint32_t samples,
                          const LightsAt& lights_at);

// random_lights() too small to fill whole lists: for tests with very many.
std::vector<Light> random_small_lights(Random& random, uint32_t count, const Camera& camera);

}  // namespace ml::test
