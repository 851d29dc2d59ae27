// Push constants of one draw of the g-buffer pass, of the forward pass and of shadow maps; and how what a
// level knows of its vertices beyond position, normal and one texture coordinate lies in the buffer Details.
#ifndef ML_SHARED_MATERIAL_H
#define ML_SHARED_MATERIAL_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct MaterialData {
  vec4 base_color;  // linear
  float metallic, roughness;
  float alpha_cutoff;
  uint double_sided;
  // 0: lit by the deferred pass. Else lit forward, and 1 + the number of the draw's first triangle in the
  // level.
  uint forward_triangle;
  uint details;  // which details there are and where: see below
  float normal_scale;
  vec3 emission;  // W/m^2/sr, linear
};
ML_SIZE(MaterialData, 56);

// MaterialData::details. The lowest four bits are the words of a vertex in the buffer Details; four more
// each, from these bits on, say where in them something lies, counted from 1; 0: there is none.
#define ML_DETAIL_TANGENT 4u                 // two words, snorm16: x, y, z, sign of the bitangent (0: none)
#define ML_DETAIL_COLOR 8u                   // two words, half floats: red, green, blue, alpha
#define ML_DETAIL_METALLIC_ROUGHNESS_UV 12u  // two words, floats; likewise those that follow
#define ML_DETAIL_NORMAL_UV 16u
#define ML_DETAIL_EMISSION_UV 20u
// Set where vertex colours and a metallic-roughness texture (white where the material has none) count.
#define ML_DETAIL_MATERIAL_BIT 0x1000000u
// Set where the material has a normal map.
#define ML_DETAIL_NORMAL_BIT 0x2000000u

// Follows MaterialData in the push constants of levels with moving meshes: takes a vertex p to
// linear * (p - pivot) + moved_pivot, in metres relative to the scene's origin.
struct MotionData {
  mat3 linear;
  vec3 pivot;
  vec3 moved_pivot;
};
ML_SIZE(MotionData, 60);

ML_NAMESPACE_END
#endif
