// The newer walk of the authors of Tiled Light Trees, over our binary trees: a subtree of up to 64 leaves is looked at
// as one of two levels, nodes that cover up to 8 leaves each, and those leaves. Every pixel asks the upper ones with
// its own depth, then the leaves below those that it hits; what the pixels of a subgroup hit is put together in one
// mask of 64 bits, and all of them take every leaf in it: no depth is asked again. Included by tree_walk.glsl.
#ifndef ML_MASKED_WALK_GLSL
#define ML_MASKED_WALK_GLSL

// Index of a node, counted from the root, in a full binary tree that is stored depth first
// (algorithms/trees/tree_chunk.h).
uint depth_first_index(uint height, uint level, uint index) {
  return level + (index << (height - level + 1u)) - uint(bitCount(index));
}

// Which of 8 nodes of a level, from `index` on, hold the pixel's depth: a bit each. Nodes from `count` or the tree's
// end on do not exist: there would be padding only. Each lane fetches one and hands it to the others. `asks`: lanes
// that do not get nothing.
uint nodes_hit(LightCursor cursor, uint height, uint level, uint index, uint count, bool asks) {
  const uint lanes = min(subgroup_lanes(), 8u), lane = gl_SubgroupInvocationID;
  uint hits = 0u, first = 0u;
  do {
    const uint own = first + lane, stored = cursor.node + depth_first_index(height, level, index + own);
    const bool exists = lane < lanes && own < count && stored < cursor.end;
    float low = any_depth, high = -any_depth;
    if (exists) {
      const TreeNode node = tree_node(stored);
      low = node.low;
      high = node.high;
    }
#ifdef COUNTING
    const uint existing = uint(bitCount(subgroup_ballot(exists)));
    if (asks) COUNT_NODES(existing);
#endif
#define NODE_OF_LANE(other) \
  if (lanes > other) { \
    const float other_low = subgroupShuffle(low, other), other_high = subgroupShuffle(high, other); \
    if (other_low <= cursor.depth && cursor.depth <= other_high) hits |= 1u << (first + other); \
  }
    NODE_OF_LANE(0u)
    NODE_OF_LANE(1u)
    NODE_OF_LANE(2u)
    NODE_OF_LANE(3u)
    NODE_OF_LANE(4u)
    NODE_OF_LANE(5u)
    NODE_OF_LANE(6u)
    NODE_OF_LANE(7u)
#undef NODE_OF_LANE
    first += lanes;
  } while (first < 8u);
  return asks ? hits : 0u;
}

// Leaves of the subtree at the cursor's node that pixels of the subgroup hit, the first 32 in x. No subtree, too tall
// or left out: height > 6.
uvec2 merged_leaves(LightCursor cursor, uint height, bool here) {
  if (height > 6u) return uvec2(0u);
  // Levels from the upper nodes to the leaves, and that of the upper nodes.
  const uint below = min(height, 3u), level = height - below;
  const uint upper = nodes_hit(cursor, height, level, 0u, 1u << level, here);
  // A root that is a leaf has nothing below.
  uvec2 mask = uvec2(below == 0u ? upper : 0u, 0u);
  uint left = below == 0u ? 0u : subgroup_or(upper);
  if (left != 0u) {
    do {
      const uint node = uint(findLSB(left));
      left &= left - 1u;
      const uint leaves = nodes_hit(cursor, height, height, node << below, 1u << below, (upper >> node & 1u) != 0u);
      if (node < 4u) {
        mask.x |= leaves << (8u * node);
      } else {
        mask.y |= leaves << (8u * node - 32u);
      }
    } while (left != 0u);
  }
  return uvec2(subgroup_or(mask.x), subgroup_or(mask.y));
}

// Goes on to the next leaves that pixels of the subgroup hit, or past the tree. A tree of more leaves is one subtree
// of 64 after another; of these, and of the nodes above them, those that no pixel hits are left out with all that is
// below.
uint masked_runs(inout LightCursor cursor, bool here) {
  bool second_half = cursor.later != 0u;
  if (!second_half) {
    do {
      const TreeNode root = tree_node(cursor.node);
      const uint skip = tree_skip(root), height = uint(findMSB(skip + 1u)) - 1u;
      const bool large = height >= 6u;
      const bool hit = subgroup_any(!large || (here && root.low <= cursor.depth && cursor.depth <= root.high));
      if (here && large) COUNT_NODES(1u);
      const uvec2 mask = merged_leaves(cursor, hit ? height : 7u, here);
      cursor.leaves = mask.x;
      cursor.later = mask.y;
      // The leftmost leaf is there wherever the root is, and full wherever it is not the last.
      const TreeNode leaf = tree_node(cursor.node + height);
      cursor.run_first = leaf.first_or_below;
      cursor.leaf_lights = tree_leaf_lights(leaf);
      cursor.run_count = height == 0u ? cursor.leaf_lights : root.first_or_below;
      cursor.node += hit && height > 6u ? 1u : skip;
    } while ((cursor.leaves | cursor.later) == 0u && cursor.node < cursor.end);
    second_half = cursor.leaves == 0u;
  }
  if (second_half) {
    cursor.leaves = cursor.later;
    cursor.later = 0u;
    cursor.run_first += 32u * cursor.leaf_lights;
    cursor.run_count -= 32u * cursor.leaf_lights;
  }
  // Neighbours are one run: its first leaf's bit.
  return cursor.leaves & ~(cursor.leaves << 1);
}

// The lights of the neighbours that begin at leaf `bit`.
void masked_run(LightCursor cursor, uint bit, out uint first, out uint count) {
  const uint leaves = min(uint(findLSB(~(cursor.leaves >> bit))), 32u - bit), before = bit * cursor.leaf_lights;
  first = cursor.run_first + before;
  count = min(before + leaves * cursor.leaf_lights, cursor.run_count) - before;
}

#endif
