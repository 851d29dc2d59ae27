// The pixel's own walk through the one tree of spheres. The post's loop, mended: leaves are marked and not guessed from their links, so that the last
// one is lit too, and the walk ends where the nodes do.
layout(constant_id = 16) const uint NODE_WORDS = 6u;  // 6 or 8 words a node
layout(scalar, binding = 16) readonly buffer Tree { uint node_count; };
layout(scalar, binding = 17) readonly buffer SphereNodes { uint sphere_words[]; };

const uint inner_node = 0xffffffffu;

struct LightCursor {
  uint node;
  vec3 position;  // m, of the pixel
};

LightCursor light_begin(SurfacePoint point) {
  COUNT_LISTED(view.light_count);
  return LightCursor(0u, point.position);
}

// Takes one node; `light` is set where it is a leaf that is hit.
void sphere_step(inout LightCursor cursor, inout uint light) {
  COUNT_NODES(1u);
  uint word = cursor.node * NODE_WORDS;
  vec3 away = vec3(uintBitsToFloat(sphere_words[word]), uintBitsToFloat(sphere_words[word + 1u]), uintBitsToFloat(sphere_words[word + 2u])) -
              cursor.position;
  float radius = uintBitsToFloat(sphere_words[word + 3u]);
  bool hit = dot(away, away) <= radius * radius;
  if (hit && sphere_words[word + 5u] != inner_node) light = sphere_words[word + 5u];
  cursor.node = hit ? cursor.node + 1u : sphere_words[word + 4u];
}

// Two nodes at most, no loop: its turns would add to those of the caller's (shaders/light_eval.glsl, LONG_LISTS).
bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = no_light;
  if (cursor.node >= node_count) return false;
  sphere_step(cursor, light);
  if (light == no_light && cursor.node < node_count) sphere_step(cursor, light);
  return true;
}
