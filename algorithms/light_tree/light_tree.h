// Tiled light trees (O'Donnell & Chajdas 2017): one tree over view depth for each screen tile.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry light_tree_entry();

}  // namespace ml
