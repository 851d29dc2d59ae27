// The worked example of the README: one list for the whole picture, of the lights whose ball reaches into the
// view.
#pragma once

#include "algorithms/algorithm.h"

namespace ml {

AlgorithmEntry frustum_list_entry();

}  // namespace ml
