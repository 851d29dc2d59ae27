// Step 2(a): the pixels of a tile, four a thread, and the bounds of all of them.
#ifndef ML_FINE_PRUNED_TILE_POINTS_GLSL
#define ML_FINE_PRUNED_TILE_POINTS_GLSL
#include "group_votes.glsl"
#include "light_volume.glsl"
#include "pruned_lists.h"

FourPoints points;
ScreenBounds tile_bounds;

// Pixels of a partial tile that lie outside the picture repeat its last row or column.
void load_points() {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 corner = gl_WorkGroupID.xy * ML_PRUNED_TILE;
  const uvec2 first = corner + 2u * uvec2(thread & 7u, thread >> 3), last = view.resolution - 1u;
  clear_depths();
  barrier();
  uint low = 0xffffffffu, high = 0u;
  // Threads that see only sky test lights with the others of their subgroup.
  points.x = points.y = points.z = points.nx = points.ny = points.nz = vec4(0);
  for (uint i = 0u; i < 4u; ++i) {
    const uvec2 pixel = min(first + uvec2(i & 1u, i >> 1), last);
    const float reversed = texelFetch(Depth, ivec2(pixel), 0).x;
    points.lit[i] = reversed > 0.0;
    if (!points.lit[i]) continue;
    const float depth = depth_from_reversed(reversed);
    const vec3 position = position_from_depth(pixel, depth);
    if (PRUNE == ML_PRUNE_FACING) {
      SurfacePoint surface;
      surface_unpack(pixel, reversed, texelFetch(Surface, ivec2(pixel), 0).xy, surface);
      points.nx[i] = surface.normal.x;
      points.ny[i] = surface.normal.y;
      points.nz[i] = surface.normal.z;
    }
    points.x[i] = position.x;
    points.y[i] = position.y;
    points.z[i] = position.z;
    const uint bits = floatBitsToUint(max(depth, 0.0));
    low = min(low, bits);
    high = max(high, bits);
  }
  add_depths(low, high);
  barrier();
  const uvec2 edge = min(corner + ML_PRUNED_TILE - 1u, last);
  tile_bounds = ScreenBounds(corner.x | edge.x << 16, corner.y | edge.y << 16, uintBitsToFloat(depth_low),
                             uintBitsToFloat(depth_high));
}

#endif
