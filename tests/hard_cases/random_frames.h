// Frames drawn by lot: cameras of every kind and lights of every shape, also around the eye.
#pragma once

#include "harness/base/random.h"
#include "tests/hard_cases/hard_cases.h"

namespace ml::test {

// Log-uniform between the two.
float log_uniform(Random& random, float low, float high);
// Perspective, orthographic and off-centre.
Camera random_camera(Random& random, uint32_t width, uint32_t height);
// 0 to some 400 lights.
std::vector<Light> random_lights(Random& random, const Camera& camera);

}  // namespace ml::test
