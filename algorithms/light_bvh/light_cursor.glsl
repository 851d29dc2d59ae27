// The pixel's own walk through the one tree of spheres. The post's loop, mended: leaves are marked and not guessed from
// their links, so that the last one is lit too, and the walk ends where the nodes do.
layout(constant_id = 32) const uint NODE_WORDS = 6u;  // 6 or 8 words a node
layout(scalar, binding = 16) readonly buffer Tree { uint node_count_data; };
uint node_count = node_count_data;  // read before all branches, as the view is (shaders/surface.glsl)
layout(scalar, binding = 17) readonly buffer SphereNodes { uint sphere_words[]; };
QUADS(SphereNodesQuads, 17);

const uint inner_node = 0xffffffffu;

struct SphereNode {
  vec3 center;   // m
  float radius;  // m
  uint next;     // the next node that is not below
  uint light;    // or inner_node
};

SphereNode sphere_node(uint node) {
  const uint word = node * NODE_WORDS;
  uvec4 a;
  uvec2 b;
  if (TEXEL_FETCH) {
    // Six words from an even one on.
    const uvec4 first = texelFetch(SphereNodesQuads, int(word >> 2)),
                second = texelFetch(SphereNodesQuads, int(word >> 2) + 1);
    const bool half_way = (word & 2u) != 0u;
    a = half_way ? uvec4(first.zw, second.xy) : first;
    b = half_way ? second.zw : second.xy;
  } else {
    a = uvec4(sphere_words[word], sphere_words[word + 1u], sphere_words[word + 2u], sphere_words[word + 3u]);
    b = uvec2(sphere_words[word + 4u], sphere_words[word + 5u]);
  }
  return SphereNode(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), b.x, b.y);
}

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
  const SphereNode node = sphere_node(cursor.node);
  const vec3 away = node.center - cursor.position;
  const bool hit = dot(away, away) <= node.radius * node.radius;
  if (hit && node.light != inner_node) light = node.light;
  cursor.node = hit ? cursor.node + 1u : node.next;
}

// Two nodes at most, no loop: its iterations would add to those of the caller's (harness/frame/shading_loops.h).
bool light_next(inout LightCursor cursor, out uint light, out float weight) {
  weight = 1.0;
  light = no_light;
  if (cursor.node >= node_count) return false;
  sphere_step(cursor, light);
  if (light == no_light && cursor.node < node_count) sphere_step(cursor, light);
  return true;
}
