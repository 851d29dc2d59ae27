// The g-buffer, packed and unpacked in one place, and the surface point that the shading loop starts from.
//
// 12 bytes a pixel: reversed 32-bit depth (0 is the sky), and two words:
//   x = normal, octahedral 2 x 12 bits | metallic 8 bits
//   y = albedo 3 x 8 bits (square-root encoded) | roughness 8 bits
#ifndef ML_SURFACE_GLSL
#define ML_SURFACE_GLSL
#include "shaders/bindings.glsl"
#include "shaders/shared/view.h"

// A storage buffer and not a uniform one: lavapipe (Mesa 22.3) writes the uniform values that branches depend on
// into the program and compiles it anew for every dispatch, inside the time that is measured.
layout(scalar, binding = BIND_VIEW) readonly buffer View { ViewData view_data; };
// Read at the start of a program, before all branches: there that driver sees that it is the same for all lanes,
// elsewhere it reads it lane by lane, which took a third of the time of shading with few lights.
ViewData view = view_data;

#ifndef SURFACE_WRITER
layout(binding = BIND_DEPTH) uniform sampler2D Depth;
layout(binding = BIND_SURFACE) uniform usampler2D Surface;
#endif

// Octahedral mapping: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2),
// 2014.
vec2 octahedral_encode(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? p : folded;
}

vec3 octahedral_decode(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}

uvec2 surface_pack(vec3 normal, vec3 albedo, float roughness, float metallic) {
  uvec2 octahedral = uvec2(round((octahedral_encode(normal) * 0.5 + 0.5) * 4094.0));
  uvec3 color = uvec3(round(sqrt(clamp(albedo, 0.0, 1.0)) * 255.0));
  uint rough = uint(round(clamp(roughness, 0.0, 1.0) * 255.0)), metal = uint(round(clamp(metallic, 0.0, 1.0) * 255.0));
  return uvec2(octahedral.x | octahedral.y << 12 | metal << 24, color.r | color.g << 8 | color.b << 16 | rough << 24);
}

vec3 surface_albedo(uint y) {
  vec3 color = vec3(y & 0xffu, y >> 8 & 0xffu, y >> 16 & 0xffu) / 255.0;
  return color * color;
}

struct SurfacePoint {
  vec3 position;   // m, camera-relative, world axes
  vec3 normal;     // unit
  vec3 to_eye;     // unit
  vec3 albedo;
  float roughness, metallic;
  float depth;     // m, view depth, > 0
  uvec2 pixel;
};

// View depth in metres from the reversed depth value (> 0).
float depth_from_reversed(float reversed) {
  return view.orthographic != 0u ? view.far - reversed * (view.far - view.near) : view.near / reversed;
}

#ifndef SURFACE_WRITER
// Position from pixel and depth. `precise`: every pass and every algorithm must see the same bits.
vec3 position_from_depth(uvec2 pixel, float depth) {
  precise vec2 uv = (vec2(pixel) + 0.5) / vec2(view.resolution);
  precise float x = view.left_edge + uv.x * (view.right_edge - view.left_edge);
  precise float y = view.top_edge + uv.y * (view.bottom_edge - view.top_edge);
  precise float scale = view.orthographic != 0u ? 1.0 : depth;
  precise vec3 position = view.right * (x * scale) + view.up * (y * scale) + view.forward * depth;
  return position;
}

void surface_unpack(uvec2 pixel, float reversed, uvec2 word, out SurfacePoint point) {
  point.pixel = pixel;
  point.depth = depth_from_reversed(reversed);
  point.position = position_from_depth(pixel, point.depth);
  point.normal = octahedral_decode(vec2(word.x & 0xfffu, word.x >> 12 & 0xfffu) / 4094.0 * 2.0 - 1.0);
  point.metallic = float(word.x >> 24) / 255.0;
  point.albedo = surface_albedo(word.y);
  point.roughness = float(word.y >> 24) / 255.0;
  point.to_eye = view.orthographic != 0u ? -view.forward : -normalize(point.position);
}

// False for the sky.
bool surface_load(uvec2 pixel, out SurfacePoint point) {
  float reversed = texelFetch(Depth, ivec2(pixel), 0).x;
  point.pixel = pixel;
  if (!(reversed > 0.0)) return false;
  surface_unpack(pixel, reversed, texelFetch(Surface, ivec2(pixel), 0).xy, point);
  return true;
}
#endif

#endif
