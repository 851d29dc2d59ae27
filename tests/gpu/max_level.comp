// One level of a pyramid of maxima out of the level before it, half as wide and high rounded down: the last
// pixel of a row or column covers three where their number is odd.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D finer;
layout(binding = 1, r32f) uniform writeonly image2D coarser;

void main() {
  ivec2 size = imageSize(coarser), at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, size))) return;
  ivec2 fine_size = textureSize(finer, 0);
  ivec2 end = ivec2(at.x + 1 == size.x ? fine_size.x : 2 * at.x + 2, at.y + 1 == size.y ? fine_size.y : 2 * at.y + 2);
  float max_value = texelFetch(finer, 2 * at, 0).r;
  for (int y = 2 * at.y; y < end.y; ++y)
    for (int x = 2 * at.x; x < end.x; ++x) max_value = max(max_value, texelFetch(finer, ivec2(x, y), 0).r);
  imageStore(coarser, at, vec4(max_value));
}
