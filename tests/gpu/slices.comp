// The slice function as a shader has it: one number of a slice for every depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/shared/slices.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
  SliceMapping mapping;
  uint depth_count;
};
layout(scalar, binding = 0) readonly buffer Depths { float depths[]; };
layout(scalar, binding = 1) writeonly buffer Slices { uint slices[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < depth_count) slices[i] = slice_of_depth(depths[i], mapping);
}
