// Frames drawn by lot: cameras of every kind and lights of every shape, also around the eye.
#pragma once

#include <functional>

#include "harness/base/random.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {

// Log-uniform between the two.
float log_uniform(Random& random, float low, float high);
// Perspective, orthographic and off-centre.
Camera random_camera(Random& random, uint32_t width, uint32_t height);
// 0 to `max_lights` lights, log-uniform, and up to 20 around the eye.
std::vector<Light> random_lights(Random& random, const Camera& camera, uint32_t max_lights);

// `cases` such frames, each for `check`, which gives the number of lights that its pixels got in all; stops
// at the first failure. Expects that the frames are full enough to mean anything.
using CheckFrame =
    std::function<uint64_t(Random& random, const Camera& camera, const std::vector<Light>& lights)>;
void for_random_frames(uint32_t width, uint32_t height, uint32_t cases, uint32_t seed,
                       const CheckFrame& check, uint32_t max_lights = 400);

}  // namespace ml::test
