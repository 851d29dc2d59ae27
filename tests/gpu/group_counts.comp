// Says how many workgroups the next pass has.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(scalar, binding = 0) writeonly buffer Groups { uint groups[]; };
layout(push_constant, scalar) uniform Push {
  uvec3 counts;
  uint first;  // word of the buffer
};

void main() {
  for (int i = 0; i < 3; ++i) groups[first + i] = counts[i];
}
