// Buffers read four words at a time. A storage buffer's words come one by one; shown as a texel buffer, the same memory
// gives four with one fetch. Which is faster depends on the device (shading.light_fetch): Mesa's software driver reads
// storage buffers lane by lane and word by word, with a branch for each, and texels all together.
#ifndef ML_QUADS_GLSL
#define ML_QUADS_GLSL
#include "shaders/bindings.glsl"
#include "shaders/constants.glsl"

#define QUADS(buffer_name, number) layout(binding = BIND_QUADS + (number)) uniform usamplerBuffer buffer_name

#endif
