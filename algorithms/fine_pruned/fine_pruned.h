// Fine pruned tiled light lists (Mikkelsen 2016): lists of 16x16 px tiles, built on the GPU and pruned by the
// lights' true volumes against every pixel.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry fine_pruned_entry();

}  // namespace ml
