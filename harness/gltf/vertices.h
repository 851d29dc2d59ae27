// What the vertices of a primitive are made of, and how they come into a Scene. Private to the importer.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "harness/gltf/parts.h"

namespace ml::gltf {

// Which accessors a primitive's vertices come from, -1 for none, and how its material reads textures.
struct VertexSource {
  VertexSource(const File& file, const tinygltf::Primitive& primitive, std::string used_in);

  std::string where;  // for errors
  size_t positions = 0;
  int normals = -1, tangents = -1, colors = -1;
  struct Coordinates {
    int accessor = -1;
    TextureMapping mapping;
  };
  // Of each TextureSlot; only base_color is read where a slot has the same.
  std::array<Coordinates, texture_slots> coordinates;
  std::array<bool, texture_slots> own_coordinates{};  // of slots that have others than base_color
  bool lacks_coordinates = false;                     // that one of its textures asks for

  // Equal for primitives whose vertices are the same.
  std::vector<double> key() const;
};

// The attributes of a primitive's vertices in the mesh's own coordinates; lists that it does not have are
// empty.
struct VertexAttributes {
  VertexAttributes(const File& file, const VertexSource& source);

  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec4> tangents;
  std::vector<glm::vec4> colors;
  std::array<std::vector<glm::vec2>, texture_slots> uvs;  // of base_color always
};

// Adds colour and texture coordinates of vertex `i` to those of the last vertex of the scene, and with
// `transform` its tangent.
void add_details(const VertexAttributes& attributes, size_t i, const glm::dmat3* transform, Scene& scene);
// Fills the lists that any vertex has up to the last vertex.
void finish_details(Scene& scene);

// A unit vector, or zero where there is none. One that is unit length in float already keeps its bits.
glm::dvec3 unit(const glm::dvec3& v);

}  // namespace ml::gltf
