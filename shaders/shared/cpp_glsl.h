// Makes the headers of this folder compile as C++ and as GLSL (scalar block layout), so that a GPU struct is
// written once.
#ifndef ML_CPP_GLSL_H
#define ML_CPP_GLSL_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#define ML_NAMESPACE_BEGIN namespace ml::gpu_data {
#define ML_NAMESPACE_END }
#define ML_FUNCTION inline
#define ML_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), "shared with GLSL: " #type)
ML_NAMESPACE_BEGIN
using uint = uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using mat3 = glm::mat3;
using uvec2 = glm::uvec2;
using uvec4 = glm::uvec4;
ML_NAMESPACE_END
#else
#define ML_NAMESPACE_BEGIN
#define ML_NAMESPACE_END
#define ML_FUNCTION
#define ML_SIZE(type, bytes)
#endif

#endif
