// The specialization constants that the harness gives to programs, by these names (harness/frame/frame_options.cpp);
// each is written down here alone. An algorithm and a pass that has no algorithm in it number their own from 32 on, and
// are given them by name too: a name that a program lacks, or one of its own that nobody gives, is an error when it is
// made.
#ifndef ML_CONSTANTS_GLSL
#define ML_CONSTANTS_GLSL

// Effects, by what the content calls for (harness/scene/effects.h has their table).
// A shape whose effect is off shines like an omni light of the same radius.
layout(constant_id = 0) const bool EFFECT_SPOTS = true;
layout(constant_id = 1) const bool EFFECT_CAPSULES = true;
layout(constant_id = 2) const bool EFFECT_WEDGES = true;
layout(constant_id = 3) const bool EFFECT_BOXES = true;
// Off, probe lights are direct ones.
layout(constant_id = 4) const bool EFFECT_PROBES = false;
layout(constant_id = 5) const bool EFFECT_SPECULAR = true;
layout(constant_id = 6) const bool EFFECT_ALPHA_MASK = false;
// Pixels that are lit forward are left out, and black until the forward pass has lit them.
layout(constant_id = 7) const bool EFFECT_FORWARD = false;
layout(constant_id = 8) const bool EFFECT_CLIP_FAR = false;
layout(constant_id = 9) const bool EFFECT_EMISSION = false;

// How a pass works, as the configuration, the algorithm and the frame have it. The shading pass needs no albedo: Result
// gets the light that the albedo multiplies, Specular the rest, and composite.comp puts them together.
layout(constant_id = 12) const bool SPLIT_TARGETS = false;
// The pixels of a subgroup walk lights together: needs votes, shuffles and arithmetic across the subgroup, and a cursor
// that can.
layout(constant_id = 13) const bool WALK_TOGETHER = false;
// The cursor takes the frame's lights in ranges (shade.comp: BlockRange).
layout(constant_id = 14) const bool WALK_RANGES = false;
// Batches are tested until one has lights that contribute, before the loop that shades is entered. Where that is a
// branch which a subgroup skips it makes no difference; a processor that takes its lanes through every loop once then
// shades as often as lights contribute, and not as often as there are batches.
layout(constant_id = 15) const bool TEST_AHEAD = false;

// What drivers and devices want.
// Loops over lights take several of them an iteration, for drivers that end a shader's loops after so many iterations:
// harness/frame/shading_loops.h has the driver, the bounds, and when it is on.
layout(constant_id = 20) const bool LONG_LISTS = false;
// Buffers are read as texels of four words (quads.glsl).
layout(constant_id = 21) const bool TEXEL_FETCH = false;
// Lanes of a subgroup, where the device has one size only; else 0. Mesa's software driver takes gl_SubgroupSize for no
// constant, and runs both sides of what depends on it.
layout(constant_id = 22) const uint SUBGROUP_LANES = 0u;

// For tests: what a workgroup shares begins as garbage, so that nothing is read before it is written.
layout(constant_id = 30) const bool POISON_SHARED = false;
const uint poison_word = 0xdeadbeefu;

#endif
