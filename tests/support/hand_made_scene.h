// Small levels made of a few rectangles, for tests that want to know where every surface is.
#pragma once

#include "harness/scene/scene.h"

namespace ml::test {

class HandMadeScene {
 public:
  HandMadeScene();
  // Returns the material's number. Number 0 is there from the start: grey, roughness 0.8.
  uint32_t material(const Material& material);
  uint32_t texture(const Texture& texture);
  // A rectangle corner, corner + u, corner + u + v, corner + v; it faces cross(u, v).
  HandMadeScene& rectangle(glm::vec3 corner, glm::vec3 u, glm::vec3 v, uint32_t material = 0);
  // An axis-aligned box that faces outwards.
  HandMadeScene& box(glm::vec3 low, glm::vec3 high, uint32_t material = 0);
  // The scene with its bounds, near 0.1 m and far 1000 m.
  Scene finish() const;

 private:
  Scene scene_;
};

// A floor at y = 0 from -200 m to 200 m, boxes of 1 to 20 m on it, thin posts, and sky above.
Scene yard();
// One square of `side` m at y = 0 around the origin of the level, seen from above by down_camera().
Scene floor_at(glm::vec3 center, float side);

}  // namespace ml::test
