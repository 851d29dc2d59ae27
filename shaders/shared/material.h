// Push constants of one draw of the g-buffer pass and of the forward pass.
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
};
ML_SIZE(MaterialData, 36);

ML_NAMESPACE_END
#endif
