// Random lights of all shapes, and points that they reach.
#pragma once

#include "harness/base/random.h"
#include "harness/scene/light.h"

namespace ml::test {

glm::vec3 any_direction(Random& random);

// Of all shapes in turn and all sizes from 0.1 mm to 10 km, around the origin.
std::vector<Light> random_shapes(uint32_t count, Random& random);

// In the light's volume, with the axes that it has, which stand upon one another; often on its edge: a cone's
// rim, a box's corner.
glm::dvec3 random_point_in(Random& random, const Light& light);

}  // namespace ml::test
