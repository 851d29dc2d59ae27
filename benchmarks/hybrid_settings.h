// The hybrid as the paper measures it: 1920x1080, 48 px tiles, 16 slices.
#pragma once

#include "algorithms/trees/tree_prepare.h"

namespace ml::bench_inputs {

inline FroxelSettings hybrid_froxels() {
  FroxelSettings settings;
  settings.tile = 48;
  settings.order = FroxelSettings::Order::depth;
  return settings;
}

}  // namespace ml::bench_inputs
