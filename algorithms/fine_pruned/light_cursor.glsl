// The lists of the pixel's tile: of direct lights, then of probe lights. Without limits they stand one after the other
// and are walked as one.
#include "pruned_lists.h"

layout(constant_id = 32) const bool PACKED = false;
layout(scalar, binding = 16) readonly buffer Visible {
  VisibleHeader visible;
  uint visible_lights[];
};
layout(scalar, binding = 17) readonly buffer TileLists { uvec2 tile_lists[]; };
layout(scalar, binding = 18) readonly buffer ListLights { uint list_lights[]; };
layout(scalar, binding = 19) readonly buffer PackedLists { uint packed_lists[]; };

// Indices into the list buffer; in the visible lights from ML_PRUNED_ALL on; packed: 24 for each list of a tile.
struct LightCursor {
  uint next, end;
  uint probe_next, probe_end;  // what is walked then
};

uint light_cell(SurfacePoint point) {
  const uvec2 tile = point.pixel / ML_PRUNED_TILE;
  return tile.y * ((view.resolution.x + ML_PRUNED_TILE - 1u) / ML_PRUNED_TILE) + tile.x;
}

uint packed_lights(uint list) {
  uint lights = 0u;
  for (uint word = 0u; word < ML_PACKED_WORDS; ++word)
    lights += packed_count(packed_lists[list * ML_PACKED_WORDS + word]);
  return lights;
}

// Goes on to the second list when the first has ended.
void next_list(inout LightCursor cursor) {
  if (!PACKED || !EFFECT_PROBES || cursor.next < cursor.end) return;
  cursor.next = cursor.probe_next;
  cursor.end = cursor.probe_end;
  cursor.probe_next = cursor.probe_end;
}

LightCursor cell_begin(uint tile, float depth, bool counted) {
  LightCursor cursor;
  if (PACKED) {
    const uint lists = EFFECT_PROBES ? 2u : 1u;
    cursor.next = tile * lists * ML_PACKED_LIGHTS;
    cursor.end = cursor.next + packed_lights(tile * lists);
    cursor.probe_next = cursor.next + ML_PACKED_LIGHTS;
    cursor.probe_end = cursor.probe_next;
    if (EFFECT_PROBES) cursor.probe_end += packed_lights(tile * lists + 1u);
  } else {
    const uvec2 list = tile_lists[tile];
    cursor.next = list.x;
    cursor.end = list.x + list.y;
    cursor.probe_next = cursor.end;
    cursor.probe_end = cursor.end;
  }
  if (counted) COUNT_LISTED(cursor.end - cursor.next + cursor.probe_end - cursor.probe_next);
  return cursor;
}

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

uint run_light(uint entry) {
  if (PACKED) return visible_lights[packed_index(packed_lists[entry / 3u], entry % 3u)];
  return entry >= ML_PRUNED_ALL ? visible_lights[entry - ML_PRUNED_ALL] : list_lights[entry];
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  next_list(cursor);
  if (cursor.next >= cursor.end) return false;
  light = run_light(cursor.next);
  cursor.next++;
  return true;
}

// A whole list is one run: bit 0 the first, bit 1 that of probe lights.
uint light_first_runs(inout LightCursor cursor, bool here) {
  uint runs = cursor.next < cursor.end ? 1u : 0u;
  if (PACKED && EFFECT_PROBES && cursor.probe_next < cursor.probe_end) runs |= 2u;
  return runs;
}

uint light_next_runs(inout LightCursor cursor, bool here) { return 0u; }

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  const bool probes = PACKED && EFFECT_PROBES && bit == 1u;
  first = probes ? cursor.probe_next : cursor.next;
  count = (probes ? cursor.probe_end : cursor.end) - first;
  return here;
}
#define CURSOR_RUNS
#define CURSOR_MORE(cursor)            \
  ((cursor).next < (cursor).end || \
   (PACKED && EFFECT_PROBES && (cursor).probe_next < (cursor).probe_end))
