// Counts its workgroups, and keeps the largest of their numbers.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(scalar, binding = 0) buffer Count {
  uint count;
  uvec3 last;
};

void main() {
  atomicAdd(count, 1);
  for (int i = 0; i < 3; ++i) atomicMax(last[i], gl_WorkGroupID[i]);
}
