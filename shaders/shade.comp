// The one shading loop. An algorithm's light_cursor.glsl says which lights are looked at; everything else is the same
// for all.
//
// The cursor provides
//   struct LightCursor;
//   LightCursor light_begin(SurfacePoint);
//   bool light_next(inout LightCursor, out uint light, out float weight);
//     false: no light is left; `light` may be no_light: nothing found this time, ask again
// and may define
//   CURSOR_LIGHT(light)  when light data does not come from light_at();
//   CURSOR_MORE(cursor)  false when light_next() will find nothing, where that is known beforehand;
//   CURSOR_RUNS          when the pixels of a subgroup can walk the lights of a cell together (shade_together.glsl), by
//     uint light_cell(SurfacePoint);
//     LightCursor cell_begin(uint cell, float depth, bool counted);
//     uint light_first_runs(inout LightCursor, bool here);  the first runs of lights, a bit for each; 0: there are none
//     uint light_next_runs(inout LightCursor, bool here);   those that follow
//     bool light_run(LightCursor, uint bit, bool here, out uint first, out uint count);
//       a run, and whether the pixel wants it
//     uint run_light(uint entry);                           a light of a run
//   CURSOR_COUNTERS      in the counting variants, with store_counters(ivec2 pixel), which writes what the algorithm
//                        counts beside the counters below; called once a pixel, forward or not;
//   CURSOR_SHARED        with poison_shared(), which writes poison_word all over the memory that the cursor shares;
//   CURSOR_CASES         with cursor_case(), light_next_in_list() and light_next_shared(): subgroups whose pixels have
//                        something in common are walked in a loop of their own.
// With FORWARD it is the fragment shader of the forward pass (shade_forward.glsl): the same loop, a pixel at a time.
// It reports its work through COUNT_LISTED(n), COUNT_NODES(n), COUNT_TRAVERSAL(class), which are nothing in the timed
// variant.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_vote : enable
#extension GL_KHR_shader_subgroup_arithmetic : enable
#extension GL_KHR_shader_subgroup_ballot : enable
#extension GL_KHR_shader_subgroup_shuffle : enable
#include "shaders/light_eval.glsl"
#include "shaders/shared/pixel_groups.h"

// Which pixels are lit forward (gbuffer.frag).
layout(binding = BIND_FORWARD) uniform usampler2D Forward;
// Surfaces give light by themselves, which comes on top of all lights' (gbuffer.frag).
layout(binding = BIND_EMISSION) uniform sampler2D Emission;
#ifndef FORWARD
// Pixels are walked in blocks of 8x8, those of a list: where something is seen, the tiles of one class, the sampled
// reference.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, binding = BIND_BLOCKS) readonly buffer Blocks { uint blocks[]; };  // column | row << 16
// Where the dispatch begins in the list, and the lights [first_light, end_light) that the cursor looks at with
// WALK_RANGES: then the sums and counts of the ranges before are in the pictures.
layout(push_constant, scalar) uniform BlockRange { uint first_block, first_light, end_light; };
layout(rgba32f, binding = BIND_RESULT) uniform image2D Result;
layout(rgba32f, binding = BIND_SPECULAR) uniform image2D Specular;
#endif

#ifdef COUNTING
layout(r32ui, binding = BIND_LISTED) uniform uimage2D Listed;
layout(r32ui, binding = BIND_TESTED) uniform uimage2D Tested;
layout(r32ui, binding = BIND_CONTRIBUTING) uniform uimage2D Contributing;
layout(r32ui, binding = BIND_NODES) uniform uimage2D Nodes;
layout(r32ui, binding = BIND_HASH) uniform uimage2D Hash;
layout(r32ui, binding = BIND_TRAVERSAL) uniform uimage2D Traversal;
uint count_listed = 0u, count_tested = 0u, count_contributing = 0u, count_nodes = 0u, count_hash = 0u,
     count_traversal = 0u;
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

const uint no_light = 0xffffffffu;

#include "light_cursor.glsl"

#ifndef CURSOR_MORE
#define CURSOR_MORE(cursor) true
#endif
#ifndef CURSOR_LIGHT
#define CURSOR_LIGHT(light) light_at(light)
#endif

// Looks at one light; true when it contributes. `data`: the light without its intensity, which few tests need.
bool test_light(SurfacePoint point, LightCore data, out LightSample from) {
  COUNT_TESTED(1u);
  return light_sample(point, data, from);
}

VEC3 sum_specular = VEC3(0);  // with SPLIT_TARGETS; the other half goes with the loop

void add_light(SurfacePoint point, LightCore data, LightSample from, float weight, inout VEC3 sum) {
  if (SPLIT_TARGETS) {
    VEC3 diffuse, specular;
    light_shade_split(point, data, from, diffuse, specular);
    sum += diffuse * REAL(weight);
    sum_specular += specular * REAL(weight);
  } else {
    sum += light_shade(point, data, from) * REAL(weight);
  }
#ifdef COUNTING
  count_contributing += 1u;
  count_hash += light_hash(data.id_shape & ML_LIGHT_ID_MASK);
#endif
}

#include "shaders/shade_alone.glsl"
#if defined(CURSOR_RUNS) && !defined(FORWARD)
#include "shaders/shade_together.glsl"
#endif

#ifdef FORWARD
#include "shaders/shade_forward.glsl"
#else
bool surface_to_light(uvec2 pixel, out SurfacePoint point) {
  return surface_load(pixel, point) && (!EFFECT_FORWARD || texelFetch(Forward, ivec2(pixel), 0).x == 0u);
}

// What the ranges before left.
void load_sums(uvec2 pixel, out VEC3 sum) {
  sum = VEC3(imageLoad(Result, ivec2(pixel)).rgb);
  if (SPLIT_TARGETS) sum_specular = VEC3(imageLoad(Specular, ivec2(pixel)).rgb);
#ifdef COUNTING
  count_listed = imageLoad(Listed, ivec2(pixel)).x;
  count_tested = imageLoad(Tested, ivec2(pixel)).x;
  count_contributing = imageLoad(Contributing, ivec2(pixel)).x;
  count_hash = imageLoad(Hash, ivec2(pixel)).x;
#endif
}

void main() {
#ifdef CURSOR_SHARED
  if (POISON_SHARED) {
    poison_shared();
    barrier();
  }
#endif
  const uint block = blocks[first_block + gl_WorkGroupID.x];
  const uvec2 pixel = uvec2(block & 0xffffu, block >> 16) * 8u + pixel_in_block(gl_LocalInvocationIndex);
  const bool inside = all(lessThan(pixel, view.resolution));
  VEC3 sum = VEC3(0);
  if (WALK_RANGES && first_light != 0u && inside) load_sums(pixel, sum);
  SurfacePoint point;
  const bool lit = inside && surface_to_light(pixel, point);
#ifdef CURSOR_RUNS
  if (WALK_TOGETHER)
    shade_together(point, lit, sum);
  else
#endif
      if (lit)
    shade_alone(point, sum);
  if (!inside) return;
  if (EFFECT_EMISSION && !SPLIT_TARGETS && !(WALK_RANGES && first_light != 0u))
    sum += VEC3(texelFetch(Emission, ivec2(pixel), 0).rgb);
  imageStore(Result, ivec2(pixel), vec4(sum, 1.0));
  if (SPLIT_TARGETS) imageStore(Specular, ivec2(pixel), vec4(sum_specular, 1.0));
#ifdef COUNTING
  imageStore(Listed, ivec2(pixel), uvec4(count_listed));
  imageStore(Tested, ivec2(pixel), uvec4(count_tested));
  imageStore(Contributing, ivec2(pixel), uvec4(count_contributing));
  imageStore(Nodes, ivec2(pixel), uvec4(count_nodes));
  imageStore(Hash, ivec2(pixel), uvec4(count_hash));
  imageStore(Traversal, ivec2(pixel), uvec4(count_traversal));
#ifdef CURSOR_COUNTERS
  store_counters(ivec2(pixel));
#endif
#endif
}
#endif
