// The shading loop for subgroups whose pixels walk lights together (WALK_TOGETHER). Included by shade.comp for cursors
// with CURSOR_RUNS.
#ifndef ML_SHADE_TOGETHER_GLSL
#define ML_SHADE_TOGETHER_GLSL
#include "shaders/light_exchange.glsl"

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

void test_four(SurfacePoint point, LightCore own, LightExtra own_extra, uint lane, uint batch, bool wanted,
               inout uint contributing) {
  test_lane(point, own, own_extra, lane, batch, wanted, contributing);
  test_lane(point, own, own_extra, lane + 1u, batch, wanted, contributing);
  test_lane(point, own, own_extra, lane + 2u, batch, wanted, contributing);
  test_lane(point, own, own_extra, lane + 3u, batch, wanted, contributing);
}

// Tests a batch of up to as many lights as there are lanes; a bit for each that contributes. Iterations are few on some
// drivers (harness/frame/shading_loops.h): four lights each, with long lists eight, and in small subgroups then none
// but the caller's.
uint test_batch(SurfacePoint point, LightCore own, LightExtra own_extra, uint batch, bool wanted) {
  uint contributing = 0u, i = 0u;
  if (LONG_LISTS && small_subgroup) {
    test_four(point, own, own_extra, 0u, batch, wanted, contributing);
    test_four(point, own, own_extra, 4u, batch, wanted, contributing);
  } else {
    do {
      test_four(point, own, own_extra, i, batch, wanted, contributing);
      if (LONG_LISTS) test_four(point, own, own_extra, i + 4u, batch, wanted, contributing);
      i += LONG_LISTS ? 8u : 4u;
    } while (i < batch);
  }
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
      do {
        add_lane(point, own, own_extra, contributing, sum);
        if (LONG_LISTS) {
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
          add_lane(point, own, own_extra, contributing, sum);
        }
      } while (subgroup_any(contributing != 0u));
    }
  } while ((runs | left) != 0u);
}

// The pixels that lie in one cell walk it together, one cell after the other. `lit`: false for lanes that only help.
// Loops test at their end: where a processor runs its lanes in step, a turn that finds nothing costs as much as any
// other.
void shade_together(SurfacePoint point, bool lit, inout VEC3 sum) {
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

#endif
