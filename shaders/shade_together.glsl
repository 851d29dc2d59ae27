// The shading loop for subgroups whose pixels walk lights together (WALK_TOGETHER). Included by shade.comp for cursors
// with CURSOR_RUNS.
#ifndef ML_SHADE_TOGETHER_GLSL
#define ML_SHADE_TOGETHER_GLSL
#include "shaders/light_exchange.glsl"
#include "shaders/loop_iterations.glsl"

// What shapes need beyond a light's core goes with it where that is cheaper than to fetch it in every lane: in small
// subgroups.
const bool extras_go_along = any_extras && small_subgroup;

// The light that a lane fetched, seen from the point.
bool sample_of_lane(SurfacePoint point, LightCore own, LightExtra own_extra, uint lane, bool wanted, out LightCore data,
                    out LightSample from) {
  data = broadcast_light(own, lane);
  if (!extras_go_along) return wanted && light_sample(point, data, from);
  const LightExtra extra = broadcast_extra(own_extra, lane);
  return wanted && light_sample(point, data, extra, from);
}

// Tests the light that `lane` fetched, and notes in `contributing` whether it contributes.
void test_lane(SurfacePoint point, LightCore own, LightExtra own_extra, uint lane, uint batch, bool wanted,
               inout uint contributing) {
  LightCore data;
  LightSample from;
  wanted = wanted && lane < batch;
  if (wanted) COUNT_TESTED(1u);
  if (sample_of_lane(point, own, own_extra, min(lane, batch - 1u), wanted, data, from)) contributing |= 1u << lane;
}

// Adds the first light of `contributing`, which may be none, and takes it out.
void add_lane(SurfacePoint point, LightCore own, LightExtra own_extra, inout uint contributing, inout VEC3 sum) {
  LightCore data;
  LightSample from;
  const uint lane = contributing != 0u ? uint(findLSB(contributing)) : 0u;
  if (sample_of_lane(point, own, own_extra, lane, contributing != 0u, data, from))
    add_light(point, data, from, 1.0, sum);
  contributing &= contributing - 1u;
}

// Tests a batch of up to as many lights as there are lanes; a bit for each that contributes. A small subgroup's is one
// iteration at most: no loop where iterations are few.
uint test_batch(SurfacePoint point, LightCore own, LightExtra own_extra, uint batch, bool wanted) {
  uint contributing = 0u, i = 0u;
#define TEST_LANE(n) test_lane(point, own, own_extra, i + n, batch, wanted, contributing);
  if (!loops_in_loops && small_subgroup) {
    STEPS_OF_4(TEST_LANE)
  } else {
    do {
      STEPS_OF_4(TEST_LANE)
      i += STRIDE_OF(4u);
    } while (i < batch);
  }
#undef TEST_LANE
  return contributing;
}

// Tests and shades the lights of some runs, a bit for each and not none, for the pixels that want them. Each lane
// fetches one light of a batch, and hands it to the others when its turn comes, so that a light is fetched once for all
// of them. Those that contribute are remembered as bits, and shaded when the batch is tested: in the order of the run,
// as everywhere. No lane leaves before all are done, for none may be missing in a shuffle. Loops end where they have
// run.
void shade_runs(SurfacePoint point, LightCursor cursor, uint runs, bool here, inout VEC3 sum) {
  const uint lanes = min(subgroup_lanes(), 32u);
  uint next = 0u, left = 0u;  // of the run that is walked
  bool wanted = false;
  do {
    LightCore own;
    LightExtra own_extra;
    uint contributing;
    do {
      if (left == 0u) {
        wanted = light_run(cursor, uint(findLSB(runs)), here, next, left);
        runs &= runs - 1u;
      }
      const uint batch = min(left, lanes);
      own = CURSOR_LIGHT(run_light(next + min(gl_SubgroupInvocationID, batch - 1u)));
      if (extras_go_along) own_extra = extra_ahead(own);
      contributing = test_batch(point, own, own_extra, batch, wanted);
      next += batch;
      left -= batch;
    } while (TEST_AHEAD && !subgroup_any(contributing != 0u) && (runs | left) != 0u);
    if (subgroup_any(contributing != 0u)) {
#define ADD_LANE(n) add_lane(point, own, own_extra, contributing, sum);
      do {
        STEPS_OF_1(ADD_LANE)
      } while (subgroup_any(contributing != 0u));
#undef ADD_LANE
    }
  } while ((runs | left) != 0u);
}

// The pixels that lie in one cell walk it together, one cell after the other. `lit`: false for lanes that only help.
// Loops test at their end: where a processor runs its lanes in step, an iteration that finds nothing costs as much as
// any other.
void shade_cells(SurfacePoint point, bool lit, inout VEC3 sum) {
  const uint none = 0xffffffffu;
  uint left = lit ? light_cell(point) : none;
  uint cell = subgroup_min(left);
  if (cell == none) return;
  do {
    const bool here = left == cell;
    if (here) left = none;
    LightCursor cursor = cell_begin(cell, point.depth, here);
    uint runs = light_first_runs(cursor, here);
    if (runs != 0u) {
      do {
        shade_runs(point, cursor, runs, here, sum);
        runs = light_next_runs(cursor, here);
      } while (runs != 0u);
    }
    cell = subgroup_min(left);
  } while (cell != none);
}

bool in_one_cell(SurfacePoint point, bool lit) {
  const uint cell = lit ? light_cell(point) : 0xffffffffu, lowest = subgroup_min(cell);
  return subgroupAll(!lit || cell == lowest);
}

// All pixels of a subgroup. Those that cannot walk together walk alone.
void shade_together(SurfacePoint point, bool lit, inout VEC3 sum) {
  const bool together = subgroups_of_several_cells || in_one_cell(point, lit);
  shade_cells(point, lit && together, sum);
  if (!subgroups_of_several_cells && lit && !together) shade_alone(point, sum);
}

#endif
