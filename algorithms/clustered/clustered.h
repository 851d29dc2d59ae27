// Practical clustered shading (Persson 2013): lights binned into froxels on the CPU, one list walked per
// pixel.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry clustered_entry();

}  // namespace ml
