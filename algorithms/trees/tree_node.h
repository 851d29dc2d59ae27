// The node of a bounding interval tree over view depth (Tiled Light Trees, listing 1): 16 bytes, in
// depth-first order.
#ifndef ML_TREES_TREE_NODE_H
#define ML_TREES_TREE_NODE_H
#include "shaders/shared/cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct TreeNode {
  float low, high;  // m, view depths between which a light below may reach a surface point; low > high: never
  // Leaf: index of its first light in the list of lights. Inner node: how many lights are below it (for
  // statistics; the listing's first light is never read there).
  uint first_or_below;
  // leaf flag 1 bit | lights of the leaf 16 bits | skip 15 bits: nodes from this one to the next that is not
  // below it.
  uint packed;
};
ML_SIZE(TreeNode, 16);

// What a cell holds: nothing (0, 0), a tree, or a list that needs no node.
struct TreeCell {
  uint first;  // tree: its first node; list: index of its first light in the list of lights
  uint end;    // tree: the first node past it; list: ML_TREE_CELL_LIST | how many lights
};
ML_SIZE(TreeCell, 8);
#define ML_TREE_CELL_LIST 0x80000000u

#define ML_TREE_LEAF 1u
#define ML_TREE_COUNT_SHIFT 1
#define ML_TREE_COUNT_MASK 0xffffu
#define ML_TREE_SKIP_SHIFT 17
// What the fields can hold: lights of one leaf, and nodes to skip. 15 bits of skip would be enough for 16384
// leaves; a walk of so many nodes takes longer than some drivers let a shader loop
// (harness/frame/shading_loops.h), so trees that large get larger leaves instead.
#define ML_TREE_MAX_LEAF_LIGHTS 65535u
#define ML_TREE_MAX_LEAVES 2048u

ML_FUNCTION bool tree_is_leaf(TreeNode node) {
  return (node.packed & ML_TREE_LEAF) != 0u;
}
ML_FUNCTION uint tree_leaf_lights(TreeNode node) {
  return (node.packed >> ML_TREE_COUNT_SHIFT) & ML_TREE_COUNT_MASK;
}
ML_FUNCTION uint tree_skip(TreeNode node) {
  return node.packed >> ML_TREE_SKIP_SHIFT;
}

ML_NAMESPACE_END
#endif
