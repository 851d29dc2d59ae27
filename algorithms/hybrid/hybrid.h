// The hybrid of Tiled Light Trees (O'Donnell & Chajdas 2017, section 3.3): a froxel grid whose cells hold a
// list or a tree, whichever suits the cell's lights.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry hybrid_entry();

}  // namespace ml
