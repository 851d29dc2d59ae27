// Per pixel exactly the lights that contribute, found beforehand and not timed: the lower bound of any
// shading pass.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry ideal_entry();

}  // namespace ml
