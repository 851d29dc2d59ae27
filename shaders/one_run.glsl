// For cursors whose cell is one list, entries [next, end): the whole list is one run (CURSOR_RUNS in shade.comp). Comes
// after struct LightCursor with these members.
#ifndef ML_ONE_RUN_GLSL
#define ML_ONE_RUN_GLSL

uint light_first_runs(inout LightCursor cursor, bool here) { return cursor.next < cursor.end ? 1u : 0u; }

uint light_next_runs(inout LightCursor cursor, bool here) { return 0u; }

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  first = cursor.next;
  count = cursor.end - cursor.next;
  return here;
}

#define CURSOR_MORE(cursor) ((cursor).next < (cursor).end)
#define CURSOR_RUNS

#endif
