// The list of the pixel's tile.
#include "pruned_lists.h"

layout(constant_id = 16) const bool PACKED = false;
layout(scalar, binding = 16) readonly buffer Visible {
  VisibleHeader visible;
  uint visible_lights[];
};
layout(scalar, binding = 17) readonly buffer TileLists { uvec2 tile_lists[]; };
layout(scalar, binding = 18) readonly buffer ListLights { uint list_lights[]; };
layout(scalar, binding = 19) readonly buffer PackedLists { uint packed_lists[]; };

// Places in the list buffer; in the visible lights from ML_PRUNED_ALL on; packed: 24 for each tile.
struct LightCursor {
  uint next, end;
};

uint light_cell(SurfacePoint point) {
  const uvec2 tile = point.pixel / ML_PRUNED_TILE;
  return tile.y * ((view.resolution.x + ML_PRUNED_TILE - 1u) / ML_PRUNED_TILE) + tile.x;
}

LightCursor cell_begin(uint tile, float depth, bool counted) {
  LightCursor cursor;
  if (PACKED) {
    cursor.next = tile * ML_PACKED_LIGHTS;
    cursor.end = cursor.next;
    for (uint word = 0u; word < ML_PACKED_WORDS; ++word) cursor.end += packed_count(packed_lists[tile * ML_PACKED_WORDS + word]);
  } else {
    const uvec2 list = tile_lists[tile];
    cursor.next = list.x;
    cursor.end = list.x + list.y;
  }
  if (counted) COUNT_LISTED(cursor.end - cursor.next);
  return cursor;
}

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

uint run_light(uint place) {
  if (PACKED) return visible_lights[packed_index(packed_lists[place / 3u], place % 3u)];
  return place >= ML_PRUNED_ALL ? visible_lights[place - ML_PRUNED_ALL] : list_lights[place];
}

bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  if (cursor.next >= cursor.end) return false;
  light = run_light(cursor.next);
  cursor.next++;
  return true;
}

// The whole list is one run.
uint light_next_runs(inout LightCursor cursor, bool here, out bool more) {
  more = false;
  return cursor.next < cursor.end ? 1u : 0u;
}

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  first = cursor.next;
  count = cursor.end - cursor.next;
  return here;
}
#define CURSOR_RUNS
#define CURSOR_MORE(cursor) ((cursor).next < (cursor).end)
