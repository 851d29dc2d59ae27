// Stores a value of the buffer to each pixel, row by row. FORMAT, IMAGE and VALUE say of what kind.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(binding = 0, FORMAT) uniform writeonly IMAGE picture;
layout(scalar, binding = 1) readonly buffer Values { VALUE values[]; };

void main() {
  ivec2 size = imageSize(picture);
  int i = int(gl_GlobalInvocationID.x);
  if (i < size.x * size.y) imageStore(picture, ivec2(i % size.x, i / size.x), values[i]);
}
