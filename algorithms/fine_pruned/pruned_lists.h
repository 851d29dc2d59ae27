// What the passes of fine_pruned hand to each other, and the packed list of the chapter (section 2.5).
#ifndef ML_FINE_PRUNED_LISTS_H
#define ML_FINE_PRUNED_LISTS_H
#include "shaders/shared/cpp_glsl.h"
ML_NAMESPACE_BEGIN

#define ML_PRUNED_TILE 16u   // px, side of a tile
#define ML_PRUNED_GROUP 64u  // threads of a tile's workgroup, 2x2 pixels each
#define ML_PRUNED_CHUNK 64u  // coarse lights that are pruned at once: bits of a thread's mask
// Limits of the chapter.
#define ML_PACKED_WORDS 8u       // 32 bytes a tile and list
#define ML_PACKED_LIGHTS 24u     // in a tile's list of direct lights, and in that of probe lights
#define ML_PACKED_VISIBLE 1024u  // in view: 10-bit indices

// What becomes of a tile's coarse list.
#define ML_PRUNE_COARSE 0u  // it is final
#define ML_PRUNE_FINE 1u    // lights whose volume holds a pixel's point are left: the chapter's
#define ML_PRUNE_FACING 2u  // the same, if the surface there faces the light

// What the screen bounds of a light are bounds of.
#define ML_BOUNDS_HULL 0u  // the hull and the balls around the light: the chapter's
#define ML_BOUNDS_BOX 1u   // the same with a hull that is not narrowed towards a cone's apex
#define ML_BOUNDS_BALL 2u  // the balls alone: around its position, and the smaller one around a cone

// In front of the visible lights' indices, which are sorted: direct lights before probe lights, and each by
// type: balls (omni, capsule), cones (spot, wedge), boxes. A light's rank in that order is its visible
// index. Tiles' lists keep the order, so a list's direct lights and its probe lights are two lists, one
// after the other.
struct VisibleHeader {
  uint count;
  uint first_cone,
      first_box;  // visible indices at which the second and the third type of direct lights begin
  uint first_probe, first_probe_cone, first_probe_box;  // and those of probe lights; `count` without any
  uvec2 spare;
};
ML_SIZE(VisibleHeader, 32);

// Where a light can be seen: first pixel | last pixel << 16, which hold the 16384 px that a picture may have,
// and view depths. Empty: first > last.
struct ScreenBounds {
  uint x, y;        // px
  float near, far;  // m
};
ML_SIZE(ScreenBounds, 16);

struct PrunedPush {
  uint columns;   // tiles across
  uint tiles;     // all of them
  uint capacity;  // lights that the list buffer holds
  // Regions of 2^region_shift tiles squared: how many stand side by side, and words from one's list to the
  // next: the number of its lights, and space for all.
  uint region_shift, region_columns, region_words;
};
ML_SIZE(PrunedPush, 24);

// First light of a list that stands in the visible lights themselves: the list buffer had no space for the
// tile, which then walks all of them.
#define ML_PRUNED_ALL 0x80000000u

// Three 10-bit indices and how many of them are in use, 0 to 3.
ML_FUNCTION uint packed_word(uint a, uint b, uint c, uint count) {
  return a | b << 10 | c << 20 | count << 30;
}
// What a tile keeps of direct lights and of probe lights, in one word of its counts.
ML_FUNCTION uint listed_pair(uint direct, uint probes) {
  return direct | probes << 16;
}
ML_FUNCTION uint packed_count(uint word) {
  return word >> 30;
}
ML_FUNCTION uint packed_index(uint word, uint slot) {
  return word >> (slot * 10u) & 0x3ffu;
}

ML_NAMESPACE_END
#endif
