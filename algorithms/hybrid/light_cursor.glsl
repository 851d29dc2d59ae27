// The list or the tree of the pixel's froxel. Lists are one-node trees, so one walk does for all; what a whole subgroup
// has in common can be walked in ways of its own (section 3.4), each behind a switch so that its gain can be measured:
//   case 0  every pixel of the subgroup walks a list: no node is looked at again
//   case 1  every pixel of the subgroup walks the same tree: its nodes are copied to shared memory
//   case 2  anything else
layout(constant_id = 32) const bool LIST_CASE = false;
layout(constant_id = 33) const bool SHARED_TREE = false;
#include "algorithms/trees/tree_walk.glsl"

#ifndef FORWARD  // fragments have no workgroup
// Nodes of all subgroups of the workgroup together: 8 KiB, the share of one is what it can copy.
const uint shared_capacity = 512u;
shared TreeNode shared_nodes[SHARED_TREE ? shared_capacity : 1u];

void poison_shared() {
  const float garbage = uintBitsToFloat(poison_word);
  if (!SHARED_TREE) return;
  for (uint i = gl_LocalInvocationIndex; i < shared_capacity; i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
    shared_nodes[i] = TreeNode(garbage, garbage, poison_word, poison_word);
}
#define CURSOR_SHARED
#endif

uint light_cell(SurfacePoint point) { return froxel_of_point(point); }

LightCursor light_begin(SurfacePoint point) { return cell_begin(light_cell(point), point.depth, true); }

bool light_next(inout LightCursor cursor, out uint light, out float weight) { return tree_next(cursor, light, weight); }

bool light_next_in_list(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = 0u;
  if (cursor.next == cursor.last) return false;
  light = run_light(cursor.next++);
  return true;
}

#ifndef FORWARD
// In shared memory the cursor's node and end count from the subgroup's first shared node.
bool light_next_shared(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = no_light;
  if (cursor.next == cursor.last) {
    if (cursor.node >= cursor.end) return false;
    tree_step(cursor, shared_nodes[cursor.node]);
    if (cursor.next == cursor.last) return true;
  }
  light = run_light(cursor.next++);
  return true;
}

// Which case the subgroup is in; brings the cursor into the form that the case's function wants.
uint cursor_case(inout LightCursor cursor) {
  if (!HAS_TREES) return 0u;
  const uint nodes = cursor.end - cursor.node;
  if (LIST_CASE && subgroupAll(nodes <= 1u)) {
    if (nodes == 1u) tree_step(cursor, tree_node(cursor.node));
    return 0u;
  }
  if (SHARED_TREE) {
    const uint share = shared_capacity / gl_NumSubgroups;
    // A pixel with a list has node 0 and end 0: a tree that begins at node 0 is told from it by its end. Asked of all
    // lanes, one question after the other.
    const bool same_node = subgroupAllEqual(cursor.node), same_end = subgroupAllEqual(cursor.end);
    if (same_node && same_end && nodes != 0u && nodes <= share) {
      // Pixels of the sky have no cursor: the lanes that are left share the copying.
      const uvec4 lanes = subgroupBallot(true);
      const uint base = gl_SubgroupID * share, step = subgroupBallotBitCount(lanes);
      for (uint i = subgroupBallotExclusiveBitCount(lanes); i < nodes; i += step)
        shared_nodes[base + i] = tree_node(cursor.node + i);
      subgroupMemoryBarrierShared();
      subgroupBarrier();
      cursor.node = base;
      cursor.end = base + nodes;
      return 1u;
    }
  }
  return 2u;
}
#define CURSOR_CASES
#endif
