// The one shading loop. An algorithm's light_cursor.glsl says which lights are looked at; everything else is the same for all.
//
// The cursor provides:  struct LightCursor;  LightCursor light_begin(SurfacePoint);
//                       bool light_next(inout LightCursor, out uint light, out float weight);
// and may define CURSOR_LIGHT(light) when light data stands elsewhere than in lights[], and CURSOR_CONTRIBUTES when the lights it
// gives are known to contribute. It reports its work through COUNT_LISTED(n), COUNT_TESTED(n), COUNT_NODES(n), COUNT_TRAVERSAL(class), which
// are nothing in the timed variant.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/light_eval.glsl"

// Pixels are walked in blocks of 8x8; with a list of blocks only those (the sampled reference), else the whole picture.
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const bool BLOCK_LIST = false;
layout(scalar, binding = BIND_BLOCKS) readonly buffer Blocks { uvec2 blocks[]; };
layout(rgba32f, binding = BIND_RESULT) writeonly uniform image2D Result;

#ifdef COUNTING
layout(r32ui, binding = BIND_LISTED) writeonly uniform uimage2D Listed;
layout(r32ui, binding = BIND_TESTED) writeonly uniform uimage2D Tested;
layout(r32ui, binding = BIND_CONTRIBUTING) writeonly uniform uimage2D Contributing;
layout(r32ui, binding = BIND_NODES) writeonly uniform uimage2D Nodes;
layout(r32ui, binding = BIND_HASH) writeonly uniform uimage2D Hash;
layout(r32ui, binding = BIND_TRAVERSAL) writeonly uniform uimage2D Traversal;
uint count_listed = 0u, count_tested = 0u, count_contributing = 0u, count_nodes = 0u, count_hash = 0u, count_traversal = 0u;
#define COUNT_LISTED(n) (count_listed += (n))
#define COUNT_TESTED(n) (count_tested += (n))
#define COUNT_NODES(n) (count_nodes += (n))
#define COUNT_TRAVERSAL(c) (count_traversal = (c))
#else
#define COUNT_LISTED(n)
#define COUNT_TESTED(n)
#define COUNT_NODES(n)
#define COUNT_TRAVERSAL(c)
#endif

#include "light_cursor.glsl"

#ifndef CURSOR_LIGHT
#define CURSOR_LIGHT(light) lights[light]
#endif

void shade_with(SurfacePoint point, uint light, float weight, inout VEC3 sum) {
  LightCore data = CURSOR_LIGHT(light);
  LightSample from;
  COUNT_TESTED(1u);
  if (!light_sample(point, data, from)) return;
  sum += light_shade(point, data, from) * REAL(weight);
#ifdef COUNTING
  count_contributing += 1u;
  count_hash += light_hash(data.id_shape & ML_LIGHT_ID_MASK);
#endif
}

void main() {
  uvec2 block = BLOCK_LIST ? blocks[gl_WorkGroupID.x] : gl_WorkGroupID.xy;
  uvec2 pixel = block * 8u + gl_LocalInvocationID.xy;
  if (any(greaterThanEqual(pixel, view.resolution))) return;
  VEC3 sum = VEC3(0);
  SurfacePoint point;
  if (surface_load(pixel, point)) {
    LightCursor cursor = light_begin(point);
    uint light;
    float weight;
    while (true) {
      if (!light_next(cursor, light, weight)) break;
      shade_with(point, light, weight, sum);
      if (LONG_LISTS) {
        if (!light_next(cursor, light, weight)) break;
        shade_with(point, light, weight, sum);
        if (!light_next(cursor, light, weight)) break;
        shade_with(point, light, weight, sum);
        if (!light_next(cursor, light, weight)) break;
        shade_with(point, light, weight, sum);
      }
    }
  }
  imageStore(Result, ivec2(pixel), vec4(sum, 1.0));
#ifdef COUNTING
  imageStore(Listed, ivec2(pixel), uvec4(count_listed));
  imageStore(Tested, ivec2(pixel), uvec4(count_tested));
  imageStore(Contributing, ivec2(pixel), uvec4(count_contributing));
  imageStore(Nodes, ivec2(pixel), uvec4(count_nodes));
  imageStore(Hash, ivec2(pixel), uvec4(count_hash));
  imageStore(Traversal, ivec2(pixel), uvec4(count_traversal));
#endif
}
