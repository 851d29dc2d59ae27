// The stackless walk through a tile's or froxel's tree (Tiled Light Trees, listing 3): strictly forwards, to the next
// node where the pixel's depth is inside, over all that is below where it is not. HAS_TREES: false where all cells are
// lists that stand in the cell, which need no walk. MASKED: subgroups that walk together do so by masked_walk.glsl.
#ifndef ML_TREE_WALK_GLSL
#define ML_TREE_WALK_GLSL
layout(constant_id = 40) const bool HAS_TREES = true;
layout(constant_id = 41) const bool MASKED = false;
#include "algorithms/trees/tree_node.h"
#include "algorithms/froxels/froxel_cell.glsl"
#include "shaders/subgroup_exchange.glsl"

layout(scalar, binding = 17) readonly buffer TreeCells { TreeCell tree_cells[]; };
layout(scalar, binding = 18) readonly buffer TreeNodes { TreeNode tree_nodes[]; };
QUADS(TreeCellsQuads, 17);
QUADS(TreeNodesQuads, 18);
layout(scalar, binding = 19) readonly buffer Indices { uint tree_lights[]; };

uint run_light(uint entry) { return index_of(tree_lights[index_word(entry)], entry); }

TreeCell tree_cell(uint cell) {
  if (!TEXEL_FETCH) return tree_cells[cell];
  const uvec4 two = texelFetch(TreeCellsQuads, int(cell >> 1));
  return (cell & 1u) != 0u ? TreeCell(two.z, two.w) : TreeCell(two.x, two.y);
}

TreeNode tree_node(uint index) {
  if (!TEXEL_FETCH) return tree_nodes[index];
  const uvec4 words = texelFetch(TreeNodesQuads, int(index));
  return TreeNode(uintBitsToFloat(words.x), uintBitsToFloat(words.y), words.z, words.w);
}

const float any_depth = 3.4e38;  // m, more than any

struct LightCursor {
  uint node, end;   // the next node, and the first past the tree
  uint next, last;  // lights of the leaf that is walked: the next, and the first past it
  float depth;      // m, of the pixel
  // A subgroup that walks together: the run of lights that this lane found, and the depths at which it shines.
  uint run_first, run_count;
  float run_low, run_high;
  // MASKED: run_first and run_count are of all lights from leaf 0 of 32 on, of which each has so many, but for the
  // last. Leaves that are walked, and those of the 32 after these.
  uint leaf_lights, leaves, later;
};

// `counted`: the pixel itself walks the tree, and does not only help.
LightCursor cell_begin(uint cell, float depth, bool counted) {
  const TreeCell stored = tree_cell(cell);
  const bool list = !HAS_TREES || (stored.end & ML_TREE_CELL_LIST) != 0u;
  // A list is at once what a tree's walk finds in a leaf.
  const uint node = list ? 0u : stored.first, end = list ? 0u : stored.end;
  const uint next = list ? stored.first : 0u, last = list ? stored.first + (stored.end & ~ML_TREE_CELL_LIST) : 0u;
  // To the masked walk a list is one leaf.
  LightCursor cursor =
      LightCursor(node, end, next, last, depth, next, last - next, -any_depth, any_depth, last - next, 1u, 0u);
#ifdef COUNTING
  if (counted) {
    // Nodes that stand side by side: one tree, or the leaves of one list.
    uint listed = last - next;
    bool tree = false;
    for (uint n = node; n < end;) {
      const TreeNode at = tree_node(n);
      tree = !tree_is_leaf(at);
      listed += tree ? at.first_or_below : tree_leaf_lights(at);
      n += tree_skip(at);
    }
    COUNT_LISTED(listed);
    COUNT_TRAVERSAL(tree ? 1u : 0u);
  }
#endif
  return cursor;
}

// Takes one node.
void tree_step(inout LightCursor cursor, TreeNode node) {
  COUNT_NODES(1u);
  bool hit = node.low <= cursor.depth && cursor.depth <= node.high;
  cursor.node += hit ? 1u : tree_skip(node);
  if (hit && tree_is_leaf(node)) {
    cursor.next = node.first_or_below;
    cursor.last = cursor.next + tree_leaf_lights(node);
  }
}

// A light of the leaf that is walked; at a leaf's end takes one node, which may lead to no light. No loop: its
// iterations would add to those of the caller's (harness/frame/shading_loops.h).
bool tree_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = no_light;
  if (cursor.next == cursor.last) {
    if (!HAS_TREES || cursor.node >= cursor.end) return false;
    tree_step(cursor, tree_node(cursor.node));
    if (cursor.next == cursor.last) return true;
  }
  light = run_light(cursor.next++);
  return true;
}

// Whether some pixel of the subgroup that is `here` has a depth in [low, high] of this lane.
bool some_depth_in(float low, float high, float depth, bool here) {
  bool some = false;
  // A few exchanges are cheaper than what small subgroups pay for a sum over all lanes.
  if (small_subgroup) {
    const float asked = here ? depth : -any_depth;
#define DEPTH_OF_LANE(lane) \
  if (SUBGROUP_LANES > lane) { \
    const float other = subgroupShuffle(asked, lane); \
    some = some || (low <= other && other <= high); \
  }
    DEPTH_OF_LANE(0u)
    DEPTH_OF_LANE(1u)
    DEPTH_OF_LANE(2u)
    DEPTH_OF_LANE(3u)
    DEPTH_OF_LANE(4u)
    DEPTH_OF_LANE(5u)
    DEPTH_OF_LANE(6u)
    DEPTH_OF_LANE(7u)
#undef DEPTH_OF_LANE
  } else {
    // Between the nearest and the farthest: no leaf is missed, some are taken in vain. As bits, which are in order for
    // depths (> 0).
    const uint bits = floatBitsToUint(max(depth, 0.0));
    const uint nearest = subgroup_min(here ? bits : 0xffffffffu),
               farthest = ~subgroup_min(here ? ~bits : 0xffffffffu);
    some = nearest <= farthest && low <= uintBitsToFloat(farthest) && uintBitsToFloat(nearest) <= high;
  }
  return some;
}

// A subgroup that walks together takes as many nodes at once as it has lanes, one each, and with them every leaf that
// holds a pixel's depth. All nodes above such a leaf hold it too, so leaves tell alone; of the others those that are
// missed tell how far the next nodes can be left out. Adds what it finds to `runs`; ends with the first that are there,
// or past the tree.
void tree_runs(inout LightCursor cursor, bool here, inout uint runs) {
  const uint lanes = min(subgroup_lanes(), 32u), lane = gl_SubgroupInvocationID;
  do {
    const uint own = cursor.node + lane, after = cursor.node + lanes;
    const bool exists = lane < lanes && own < cursor.end;
    if (here) COUNT_NODES(min(max(cursor.end, cursor.node) - cursor.node, lanes));
    TreeNode node = TreeNode(any_depth, -any_depth, 0u, 0u);
    if (exists) node = tree_node(own);
    const bool hit = some_depth_in(node.low, node.high, cursor.depth, here);
    const bool leaf = exists && tree_is_leaf(node);
    if (exists) {
      cursor.run_first = node.first_or_below;
      cursor.run_count = tree_leaf_lights(node);
      cursor.run_low = node.low;
      cursor.run_high = node.high;
    }
    runs |= subgroup_ballot(hit && leaf);
    // The first missed node whose nodes go on past these is above all others of the kind.
    const uint next = own + tree_skip(node);
    const uint jumps = subgroup_ballot(exists && !hit && next > after);
    cursor.node = jumps != 0u ? subgroupShuffle(next, uint(findLSB(jumps))) : after;
  } while (runs == 0u && cursor.node < cursor.end);
}

#include "algorithms/trees/masked_walk.glsl"

// A list is one run, in every lane.
uint light_first_runs(inout LightCursor cursor, bool here) {
  uint runs = cursor.next != cursor.last ? 1u : 0u;
  if (HAS_TREES && MASKED) {
    if (cursor.node < cursor.end) runs = masked_runs(cursor, here);
  } else if (HAS_TREES) {
    tree_runs(cursor, here, runs);
  }
  return runs;
}

uint light_next_runs(inout LightCursor cursor, bool here) {
  uint runs = 0u;
  if (HAS_TREES && MASKED) {
    if (cursor.later != 0u || cursor.node < cursor.end) runs = masked_runs(cursor, here);
  } else if (HAS_TREES && cursor.node < cursor.end) {
    tree_runs(cursor, here, runs);
  }
  return runs;
}

bool light_run(LightCursor cursor, uint bit, bool here, out uint first, out uint count) {
  if (!HAS_TREES) {
    first = cursor.run_first;
    count = cursor.run_count;
    return here;
  }
  if (MASKED) {
    masked_run(cursor, bit, first, count);
    return here;
  }
  first = subgroupShuffle(cursor.run_first, bit);
  count = subgroupShuffle(cursor.run_count, bit);
  const float low = subgroupShuffle(cursor.run_low, bit), high = subgroupShuffle(cursor.run_high, bit);
  return here && low <= cursor.depth && cursor.depth <= high;
}

#define CURSOR_RUNS

#endif
