#include "tests/support/hand_made_scene.h"

#include <limits>

namespace ml::test {

HandMadeScene::HandMadeScene() {
  Material grey;
  grey.name = "grey";
  grey.base_color = {0.5f, 0.4f, 0.3f, 1};
  scene_.name = "hand-made";
  scene_.materials.push_back(grey);
}

uint32_t HandMadeScene::material(const Material& material) {
  scene_.materials.push_back(material);
  return static_cast<uint32_t>(scene_.materials.size() - 1);
}

uint32_t HandMadeScene::texture(const Texture& texture) {
  scene_.textures.push_back(texture);
  return static_cast<uint32_t>(scene_.textures.size() - 1);
}

HandMadeScene& HandMadeScene::rectangle(glm::vec3 corner, glm::vec3 u, glm::vec3 v, uint32_t material) {
  const glm::vec3 normal = glm::normalize(glm::cross(u, v));
  const auto first = static_cast<uint32_t>(scene_.vertices.size());
  for (glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
    scene_.vertices.push_back({corner + u * at.x + v * at.y, normal, at});
  const auto begin = static_cast<uint32_t>(scene_.indices.size());
  for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene_.indices.push_back(first + i);
  if (!scene_.draws.empty() && scene_.draws.back().material == material)
    scene_.draws.back().index_count += 6;
  else
    scene_.draws.push_back({begin, 6, material});
  return *this;
}

HandMadeScene& HandMadeScene::box(glm::vec3 low, glm::vec3 high, uint32_t material) {
  const glm::vec3 size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  rectangle(low, y, x, material).rectangle(low, x, z, material).rectangle(low, z, y, material);
  rectangle(high, -x, -y, material).rectangle(high, -z, -x, material).rectangle(high, -y, -z, material);
  return *this;
}

Scene HandMadeScene::finish() const {
  Scene scene = scene_;
  scene.bounds = {glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
  for (const Vertex& vertex : scene.vertices) {
    scene.bounds.min = glm::min(scene.bounds.min, vertex.position);
    scene.bounds.max = glm::max(scene.bounds.max, vertex.position);
  }
  scene.near = 0.1f;
  scene.far = 1000;
  CameraPath path;
  path.name = "default";
  path.keys = {{0, {0, 2, 10}, {0, 1, 0}}};
  scene.paths = {path};
  return scene;
}

Scene yard() {
  HandMadeScene made;
  Material tile;
  tile.name = "tile";
  tile.base_color = {0.2f, 0.6f, 0.7f, 1};
  tile.roughness = 0.3f;
  tile.metallic = 0.5f;
  const uint32_t shiny = made.material(tile);
  made.rectangle({-200, 0, 200}, {400, 0, 0}, {0, 0, -400});
  for (int i = 0; i < 12; ++i) {
    const auto n = static_cast<float>(i);
    const float x = n * 3.7f - 20, z = 8 - n * n * 1.3f;
    made.box({x, 0, z - 2 - n * 0.5f}, {x + 1 + n * 0.4f, 1 + n * 0.7f, z}, i % 2 ? shiny : 0);
    made.box({x - 0.6f, 0, z + 1}, {x - 0.5f, 3, z + 1.1f}, shiny);  // a post, for silhouettes
  }
  return made.finish();
}

Scene floor_at(glm::vec3 center, float side) {
  return HandMadeScene()
      .rectangle(center + glm::vec3(-side / 2, 0, side / 2), {side, 0, 0}, {0, 0, -side})
      .finish();
}

}  // namespace ml::test
