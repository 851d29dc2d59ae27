// How loops are written for drivers that end a shader's loops after so many iterations: the one file of shaders that
// knows of it. harness/frame/shading_loops.h is its counterpart: it has the driver, the bounds of these loops, and when
// LONG_LISTS is on; then they take eight steps an iteration.
//
// The same driver is why loops leave by `break`: with a condition at their end it lost lights, as if pixels that had
// left a loop took what others found in later iterations.
#ifndef ML_LOOP_ITERATIONS_GLSL
#define ML_LOOP_ITERATIONS_GLSL
#include "shaders/constants.glsl"

// The body of a loop: step(n) for each of the 1, 2 or 4 steps of an iteration from here, n from 0u. A step may come too
// late: it does nothing where nothing is left.
#define STEPS_OF_1(step)                                                                              \
  step(0u) if (LONG_LISTS) { step(1u) step(2u) step(3u) step(4u) step(5u) step(6u) step(7u) }
#define STEPS_OF_2(step)                                                                              \
  step(0u) step(1u) if (LONG_LISTS) { step(2u) step(3u) step(4u) step(5u) step(6u) step(7u) }
#define STEPS_OF_4(step)                                                                              \
  step(0u) step(1u) step(2u) step(3u) if (LONG_LISTS) { step(4u) step(5u) step(6u) step(7u) }
// How far such an iteration comes.
#define STRIDE_OF(steps) (LONG_LISTS ? 8u : steps)

// Loops inside loops: two loops would end as one does after so many iterations of both.
const bool loops_in_loops = !LONG_LISTS;
// A subgroup that walks several cells, one after the other, takes the iterations of all of them.
const bool subgroups_of_several_cells = !LONG_LISTS;

#endif
