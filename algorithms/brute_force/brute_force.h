// Every light for every pixel: the trusted answer, in single or double precision.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry brute_force_entry();

}  // namespace ml
