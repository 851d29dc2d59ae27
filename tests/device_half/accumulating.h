// An algorithm with two passes of its own around the shading loop, an image, a history, and a counter of each
// kind: it stands for what stochastic algorithms bring, and proves that the interface takes them.
#pragma once

#include "algorithms/algorithm.h"

namespace ml::test {

AlgorithmEntry accumulating_entry();

}  // namespace ml::test
