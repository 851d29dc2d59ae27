// BVH-accelerated shading (Mamacos): every pixel walks one tree of spheres over all lights.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry light_bvh_entry();

}  // namespace ml
