// Builds indexed, welded meshes with one run of indices per material.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

// `value` rounded to 1/1024 m: exact in float up to 16 km, so that a last-bit difference in what computed it
// does not reach the vertices, and exported bytes are the same everywhere.
double quantised(double value);
glm::dvec3 quantised(const glm::dvec3& value);

// Positions are quantised; equal vertices (position and normal) become one; triangles without area are left
// out.
class MeshBuilder {
 public:
  enum Face : unsigned { west = 1, east = 2, bottom = 4, top = 8, north = 16, south = 32, all = 63 };

  uint32_t add_material(const Material& material);

  // Counter-clockwise from outside, flat shaded.
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint32_t material);
  // Flat; a, b, c, d counter-clockwise. Bent quads are shaded as two triangles.
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
            uint32_t material);
  // Axis-aligned; `faces` says which sides are made (west is -x, north is -z).
  void box(const glm::dvec3& min, const glm::dvec3& max, uint32_t material, unsigned faces = all);
  // A box bent to eight corners; corner i is at the upper end of x, y, z where bit 0, 1, 2 of i is set.
  void block(const std::array<glm::dvec3, 8>& corners, uint32_t material, unsigned faces = all);
  // An upright prism of `sides` sides with its top; radii may differ.
  void prism(const glm::dvec3& foot, double height, double foot_radius, double top_radius, int sides,
             uint32_t material);

  // An upright cone with its under side.
  void cone(const glm::dvec3& foot, double height, double radius, int sides, uint32_t material);

  // For smooth surfaces: a vertex of its own normal (made unit length), and triangles over such vertices.
  uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal);
  void smooth_triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t material);

  // The scene of all that was built; the builder is empty afterwards.
  Scene finish();

 private:
  struct Key {
    std::array<float, 6> values;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    size_t operator()(const Key& key) const;
  };

  std::vector<Vertex> vertices_;
  std::unordered_map<Key, uint32_t, KeyHash> known_;
  std::vector<Material> materials_;
  std::vector<std::vector<uint32_t>> indices_;  // by material
};

enum class Finish { plain, double_sided, forward };

// A function that adds an opaque material without textures to `mesh` and returns its number.
inline auto adder_of_materials(MeshBuilder& mesh) {
  return [&mesh](const char* name, const glm::vec3& colour, float metallic, float roughness,
                 Finish finish = Finish::plain) {
    Material material;
    material.name = name;
    material.base_color = glm::vec4(colour, 1);
    material.metallic = metallic;
    material.roughness = roughness;
    material.double_sided = finish == Finish::double_sided;
    material.forward = finish == Finish::forward;
    return mesh.add_material(material);
  };
}

}  // namespace ml
