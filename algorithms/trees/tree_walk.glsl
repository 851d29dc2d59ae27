// The stackless walk through a tile's or froxel's tree (Tiled Light Trees, listing 3): strictly forwards, to the next
// node where the pixel's depth is inside, over all that is below where it is not.
// Before it comes the constant HAS_TREES: false where all cells are lists that stand in the cell, which need no walk.
#ifndef ML_TREE_WALK_GLSL
#define ML_TREE_WALK_GLSL
#include "algorithms/trees/tree_node.h"
#include "shaders/shared/slices.h"

layout(scalar, binding = 16) readonly buffer Grid {
  SliceMapping slice_mapping;
  uint tile_size, tile_columns, tile_count;
};
layout(scalar, binding = 17) readonly buffer TreeCells { TreeCell tree_cells[]; };
layout(scalar, binding = 18) readonly buffer TreeNodes { TreeNode tree_nodes[]; };
layout(scalar, binding = 19) readonly buffer Indices { uint tree_lights[]; };

const uint no_node = 0x80000000u;

struct LightCursor {
  uint node, end;   // the next node, and the first behind the tree
  uint next, last;  // lights of the leaf that is walked: the next, and the first behind
  float depth;      // m, of the pixel
  // A subgroup that walks together: the node that this lane fetched, and the number of the first lane's.
  TreeNode fetched;
  uint fetched_first;
};

// `counted`: the pixel itself walks the tree, and does not only help.
LightCursor cell_begin(uint cell, float depth, bool counted) {
  const TreeCell place = tree_cells[cell];
  const bool list = !HAS_TREES || (place.end & ML_TREE_CELL_LIST) != 0u;
  // A list is at once what a tree's walk finds in a leaf.
  const uint node = list ? 0u : place.first, end = list ? 0u : place.end;
  const uint next = list ? place.first : 0u, last = list ? place.first + (place.end & ~ML_TREE_CELL_LIST) : 0u;
  LightCursor cursor = LightCursor(node, end, next, last, depth, TreeNode(0.0, 0.0, 0u, 0u), no_node);
#ifdef COUNTING
  if (counted) {
    // Nodes that stand side by side: one tree, or the leaves of one list.
    uint listed = last - next;
    bool tree = false;
    for (uint n = node; n < end; n += tree_skip(tree_nodes[n])) {
      tree = !tree_is_leaf(tree_nodes[n]);
      listed += tree ? tree_nodes[n].first_or_below : tree_leaf_lights(tree_nodes[n]);
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

// A light of the leaf that is walked; at a leaf's end takes one node, which may lead to no light. No loop: a loop's turns would add to those of
// the caller's (shaders/light_eval.glsl, LONG_LISTS).
bool tree_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = no_light;
  if (cursor.next == cursor.last) {
    if (!HAS_TREES || cursor.node >= cursor.end) return false;
    tree_step(cursor, tree_nodes[cursor.node]);
    if (cursor.next == cursor.last) return true;
  }
  light = tree_lights[cursor.next++];
  return true;
}

// A subgroup that walks together goes into every node that one of its pixels hits. The lanes fetch as many nodes at once.
void tree_fetch(inout LightCursor cursor) {
  cursor.fetched_first = cursor.node;
  cursor.fetched = tree_nodes[min(cursor.node + gl_SubgroupInvocationID, cursor.end - 1u)];
}

bool light_next_run(inout LightCursor cursor, bool here, out uint first, out uint count, out bool wanted) {
  first = cursor.next;
  count = cursor.last - cursor.next;
  wanted = here;
  cursor.next = cursor.last;
  if (!HAS_TREES || count != 0u) return count != 0u;  // a list
  while (cursor.node < cursor.end) {
    if (cursor.node - cursor.fetched_first >= gl_SubgroupSize) tree_fetch(cursor);
    const uint lane = cursor.node - cursor.fetched_first;
    const TreeNode node = TreeNode(subgroupShuffle(cursor.fetched.low, lane), subgroupShuffle(cursor.fetched.high, lane),
                                   subgroupShuffle(cursor.fetched.first_or_below, lane), subgroupShuffle(cursor.fetched.packed, lane));
    if (here) COUNT_NODES(1u);
    wanted = here && node.low <= cursor.depth && cursor.depth <= node.high;
    const bool hit = subgroupAny(wanted);
    cursor.node += hit ? 1u : tree_skip(node);
    if (hit && tree_is_leaf(node)) {
      first = node.first_or_below;
      count = tree_leaf_lights(node);
      return true;
    }
  }
  return false;
}

uint run_light(uint place) { return tree_lights[place]; }
#define CURSOR_RUNS

#endif
