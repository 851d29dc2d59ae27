// For tests: what a workgroup shares begins as garbage, so that nothing is read before it is written.
#ifndef ML_POISON_GLSL
#define ML_POISON_GLSL

layout(constant_id = 15) const bool POISON_SHARED = false;
const uint poison_word = 0xdeadbeefu;

#endif
