// Push constants of one draw of the g-buffer pass.
#ifndef ML_SHARED_MATERIAL_H
#define ML_SHARED_MATERIAL_H
#include "cpp_glsl.h"
ML_NAMESPACE_BEGIN

struct MaterialData {
  vec4 base_color;  // linear
  float metallic, roughness;
  float alpha_cutoff;
  uint double_sided;
};
ML_SIZE(MaterialData, 32);

ML_NAMESPACE_END
#endif
