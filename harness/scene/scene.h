// A level as the bench sees it: triangles, materials, cameras and the lights that the file itself brings.
//
// Units: metres, y up, right-handed. Everything is relative to `origin`, so that a level far from its own
// zero keeps its precision: importers add up transforms in double, choose an origin near the level's middle,
// subtract it in double, and only then round.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/scene/camera.h"
#include "harness/scene/light.h"
#include "harness/scene/light_defaults.h"

namespace ml {

struct Vertex {
  glm::vec3 position;  // m, relative to Scene::origin
  glm::vec3 normal;    // unit length
  glm::vec2 uv;        // texture coordinates, 0 where the file has none
};
static_assert(sizeof(Vertex) == 32);

// What some levels know of their vertices beyond Vertex. Each list is empty, which means its default for all
// vertices, or has one element a vertex.
struct VertexDetails {
  // Unit direction of growing u of the normal texture, in w the sign of the bitangent w * cross(normal,
  // tangent); w 0: there is none, and it is derived from the texture coordinates.
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec4> colors;  // linear, multiply base colour and alpha; at least 0, default 1
  // Texture coordinates of these textures where they are not Vertex::uv.
  std::vector<glm::vec2> metallic_roughness_uv, normal_uv, emission_uv;

  bool empty() const {
    return tangents.empty() && colors.empty() && metallic_roughness_uv.empty() && normal_uv.empty() &&
           emission_uv.empty();
  }
};

// How a texture is read between and beyond its pixels, as glTF has it.
enum class Filter : uint32_t { nearest, linear };
enum class MipFilter : uint32_t { none, nearest, linear };  // none: the picture alone, no smaller ones
enum class Wrap : uint32_t { repeat, mirrored_repeat, clamp_to_edge };
struct Sampler {
  Filter magnify = Filter::linear, minify = Filter::linear;
  MipFilter mip = MipFilter::none;
  Wrap u = Wrap::repeat, v = Wrap::repeat;
  auto operator<=>(const Sampler&) const = default;
};

// 8 bits a channel, row by row from the top. Colours are sRGB with linear alpha, data is linear: which of the
// two follows from what a material takes it for.
struct Texture {
  std::string name;
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // width * height * 4
  Sampler sampler = {};
};

enum class AlphaMode : uint32_t {
  opaque = 0,
  mask = 1
};  // glTF BLEND is drawn as mask with cutoff 0.5, and said so in Scene::notes

struct Material {
  std::string name;
  glm::vec4 base_color{1};      // linear factor, alpha in a
  int base_color_texture = -1;  // index into Scene::textures, -1 for none
  float metallic = 0;           // [0, 1]
  float roughness = 0.8f;       // [0, 1]
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  // Indices into Scene::textures as above. Roughness is multiplied by green and metallic by blue of the
  // first; the second holds normals in tangent space, x and y multiplied by normal_scale.
  int metallic_roughness_texture = -1, normal_texture = -1;
  float normal_scale = 1;
  // W/m^2/sr that the surface gives by itself, linear, at least 0; multiplied by the texture.
  glm::vec3 emission{0};
  int emission_texture = -1;
  bool forward = false;  // lit in its mesh's own fragment shader, and left out of the deferred pass
};

// A run of indices with one material.
struct Draw {
  uint32_t first_index = 0;
  uint32_t index_count = 0;  // a multiple of 3
  uint32_t material = 0;
  int motion = -1;  // index into Scene::draw_motions; -1: it stands still
};

// What carries a draw (draw_motion.h).
struct DrawMotion {
  size_t node = 0;          // of Scene::motions
  glm::dmat4 from_rest{1};  // from the scene's coordinates, as Scene::vertices have them, to the node's own
  glm::vec3 pivot{0};       // m, the middle of the draw's vertices
};

struct Bounds {
  glm::vec3 min{0}, max{0};
  glm::vec3 size() const { return max - min; }
  glm::vec3 center() const { return 0.5f * (min + max); }
};

struct Scene {
  std::string name;
  glm::dvec3 origin{0};  // m, in the file's own world
  std::vector<Vertex> vertices;
  VertexDetails details;
  std::vector<uint32_t> indices;  // triangles, counter-clockwise from outside
  std::vector<Draw> draws;
  std::vector<Material> materials;  // at least one
  std::vector<Texture> textures;
  LightDefaults light_defaults;
  std::vector<Light> lights;  // the file's own (KHR_lights_punctual), for placement `gltf`
  // The node of `motions` that carries each of `lights`, -1 where it stands still; empty where all do.
  std::vector<int> light_nodes;
  Rejections rejected_lights;     // further lights of the file, which cannot be given a position or a radius
  std::vector<CameraPath> paths;  // the first is `default`
  // Null where nothing moves. The level as it stands here is that of motions->begin().
  std::shared_ptr<const NodeMotions> motions;
  glm::dvec3 motion_center{0};  // m, what was subtracted from the world of `motions`
  std::vector<DrawMotion> draw_motions;
  std::vector<Bounds> rooms;  // from floor to ceiling, for the placements `stage` and `room`
  Bounds bounds;              // of the vertices, wherever they move
  float near = 0.1f;          // m
  float far = 1000;           // m, the depth range of grids: about the longest view
  std::vector<std::string>
      notes;  // one line each: what the importer could not represent, to be shown to the user

  uint32_t triangle_count() const { return static_cast<uint32_t>(indices.size() / 3); }
  // The path of that name. Throws UsageError with the nearest known name.
  const CameraPath& path(const std::string& path_name) const;
};

}  // namespace ml
