// The parameters of a froxel grid, as every algorithm that has one shows them.
#pragma once

#include <string>
#include <vector>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/parameters.h"

namespace ml {

// tile, slices, zmin, zmax, refinement, ball_test, index_bits.
std::vector<ParameterInfo> froxel_parameters();
FroxelSettings froxel_settings(const Parameters& parameters);
// What is wrong with their combination at this resolution, or "".
std::string froxel_check(const Parameters& parameters, uint32_t width, uint32_t height);

ParameterInfo ball_test_parameter();
ParameterInfo index_bits_parameter();
// The two as they stand in the settings of froxel_settings() and of algorithms without slices.
void read_list_settings(const Parameters& parameters, FroxelSettings& settings);

// How pixels walk the lights of a cell: `walk`.
ParameterInfo walk_parameter();
// Whether a subgroup's pixels walk together, in whatever way.
bool walk_together(const Parameters& parameters);

}  // namespace ml
