// Normals out of a texture in tangent space (glTF 2.0, section 3.9.3 and "normalTexture": x right, y up, z towards the
// viewer).
#ifndef ML_NORMAL_MAP_GLSL
#define ML_NORMAL_MAP_GLSL

// The direction in which u grows on the surface, at right angles to its normal, and in w the sign of the bitangent,
// which points to where v falls. 0 where texture coordinates have no area. From differences between neighbouring
// pixels, for meshes without tangents.
vec4 derived_tangent(vec3 normal, vec3 position, vec2 uv) {
  const vec3 right = dFdx(position), down = dFdy(position);
  const vec2 uv_right = dFdx(uv), uv_down = dFdy(uv);
  const float area = uv_right.x * uv_down.y - uv_down.x * uv_right.y;
  const vec3 along_u = (right * uv_down.y - down * uv_right.y) * sign(area);
  const vec3 against_v = (right * uv_down.x - down * uv_right.x) * sign(area);
  const vec3 tangent = along_u - normal * dot(normal, along_u);
  const float length_squared = dot(tangent, tangent);
  // Written so that NaN is none either.
  if (!(length_squared > 1e-36 && length_squared < 1e36)) return vec4(0.0);
  return vec4(tangent * inversesqrt(length_squared), dot(cross(normal, tangent), against_v) < 0.0 ? -1.0 : 1.0);
}

// `normal` is the vertices' own, unit; `tangent` theirs, w 0 where there is none; `texel` what the texture holds.
vec3 mapped_normal(vec3 normal, vec4 tangent, vec4 derived, vec3 texel, float scale) {
  vec3 t = tangent.xyz - normal * dot(normal, tangent.xyz);
  float handedness = tangent.w < 0.0 ? -1.0 : 1.0;
  if (abs(tangent.w) > 0.5 && dot(t, t) > 1e-12) {
    t = normalize(t);
  } else {
    if (derived.w == 0.0) return normal;
    t = derived.xyz;
    handedness = derived.w;
  }
  vec3 n = texel * 2.0 - 1.0;
  n.xy *= scale;
  const vec3 mapped = t * n.x + cross(normal, t) * (handedness * n.y) + normal * n.z;
  const float length_squared = dot(mapped, mapped);
  return length_squared > 1e-12 && length_squared < 1e12 ? mapped * inversesqrt(length_squared) : normal;
}

#endif
