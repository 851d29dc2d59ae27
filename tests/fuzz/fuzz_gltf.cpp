// Any bytes, as GLB or as JSON: the importer gives a usable scene, or one of the project's own errors, and
// nothing else.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "harness/base/error.h"
#include "harness/gltf/gltf.h"
#include "harness/scene/scene.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const ml::Scene& scene) {
  require(!scene.indices.empty() && scene.indices.size() % 3 == 0 && !scene.materials.empty() &&
          !scene.paths.empty());
  require(scene.near > 0 && scene.far > scene.near);
  for (uint32_t index : scene.indices) require(index < scene.vertices.size());
  for (const ml::Vertex& vertex : scene.vertices) {
    require(std::abs(glm::length(vertex.normal) - 1) < 1e-3f);
    require(std::isfinite(vertex.uv.x) && std::isfinite(vertex.uv.y));
    for (int c = 0; c < 3; ++c) require(std::abs(vertex.position[c]) <= 2.1e9f);
  }
  size_t covered = 0;
  for (const ml::Draw& draw : scene.draws) {
    require(draw.first_index == covered && draw.index_count % 3 == 0 &&
            draw.material < scene.materials.size());
    covered += draw.index_count;
  }
  require(covered == scene.indices.size());
  for (const ml::Material& material : scene.materials) {
    for (int texture : {material.base_color_texture, material.metallic_roughness_texture,
                        material.normal_texture, material.emission_texture})
      require(texture >= -1 && texture < static_cast<int>(scene.textures.size()));
    for (int c = 0; c < 3; ++c) require(material.emission[c] >= 0 && material.emission[c] <= 1e9f);
  }
  const ml::VertexDetails& details = scene.details;
  for (size_t size : {details.colors.size(), details.tangents.size(), details.metallic_roughness_uv.size(),
                      details.normal_uv.size(), details.emission_uv.size()})
    require(size == 0 || size == scene.vertices.size());
  for (const glm::vec4& tangent : details.tangents)
    require(tangent.w == 0 || std::abs(glm::length(glm::vec3(tangent)) - 1) < 1e-3f);
  for (const ml::CameraPath& path : scene.paths) {
    require(!path.keys.empty());
    for (size_t i = 1; i < path.keys.size(); ++i) require(path.keys[i].time > path.keys[i - 1].time);
    path.sample(1, 3, 64, 48, scene.near, scene.far);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    check(ml::import_gltf_memory(std::as_bytes(std::span(data, size)), "fuzz.glb", -1, 1, glm::dvec3(0)));
  } catch (const ml::Error& error) {
    require(std::string(error.what()).find('\n') == std::string::npos);
  }
  return 0;
}
