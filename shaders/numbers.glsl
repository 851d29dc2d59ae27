// The number type of the shading code: float, or double where FP64 is defined (brute force as reference).
#ifndef ML_NUMBERS_GLSL
#define ML_NUMBERS_GLSL

#ifdef FP64
#define REAL double
#define VEC3 dvec3
#else
#define REAL float
#define VEC3 vec3
#endif

#endif
