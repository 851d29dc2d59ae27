// The pieces of the glTF importer: each turns one part of a checked File into its part of a Scene. Private to
// the importer.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "harness/gltf/file.h"
#include "harness/scene/scene.h"

namespace ml::gltf {

// nodes.cpp
struct PlacedNode {
  size_t node = 0;
  glm::dmat4 world{1};
  bool visible = true;  // neither it nor a node above it is hidden (KHR_node_visibility)
};
// Proves that the nodes form trees (no cycle, no second parent, no more than max_depth levels).
// Returns each node's parent, -1 for roots.
std::vector<int> check_tree(const File& file);
// The nodes of a scene in depth-first order with their world transforms; all finite. A scene may list nodes
// below others, which glTF does not allow: each comes once, where its parents put it, with a note.
std::vector<PlacedNode> place_nodes(File& file, int scene_index);
// The world transform of every node of the file, as check_tree's parents have it; not proven finite.
std::vector<glm::dmat4> world_transforms(const File& file);
// A node's own transform; for one that is given as a matrix `pose` stays empty.
glm::dmat4 local_transform(const File& file, size_t node);
Pose local_pose(const File& file, size_t node);

// animation.cpp. The nodes that move, and which of the file's nodes each is.
struct Movement {
  std::shared_ptr<const NodeMotions> motions;  // null where nothing moves
  std::vector<int> index;                      // into motions, by node of the file; -1: it is not there

  int of(size_t node) const { return motions ? index[node] : -1; }
  // The same, but -1 too where the node is there and stands still.
  int moving(size_t node) const {
    return of(node) >= 0 && motions->moves(static_cast<size_t>(of(node))) ? of(node) : -1;
  }
};
// The motion of all cameras, lights and meshes that move or stand below what moves, and of still cameras
// beside them; proves that times increase. Moves `nodes` to where they are when it begins.
Movement load_movement(File& file, std::vector<PlacedNode>& nodes);

// mesh.cpp. Fills vertices, indices, draws, those that move apart, and bounds, and subtracts the whole
// metres nearest to the middle of the bounds (or `center`, where one is given). Returns what was subtracted.
glm::dvec3 load_meshes(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                       const glm::dvec3* center, Scene& scene);

// material.cpp. The materials in the file's order and the textures that they use; a texture that cannot
// be read is left out, with a note. At the end comes a material for primitives without one; it is dropped by
// load_meshes when nothing uses it. "forward" true in a material's extras.manylights makes it a forward
// material.
void load_materials(File& file, Scene& scene);

// What a material takes textures for.
enum class TextureSlot : size_t { base_color, metallic_roughness, normal, emission };
constexpr size_t texture_slots = 4;
bool has_texture(const File& file, int material, TextureSlot slot);

// Where a material's texture finds its coordinates, and how they are moved (KHR_texture_transform).
struct TextureMapping {
  int set = 0;  // of TEXCOORD_n
  glm::dvec2 offset{0}, scale{1};
  double rotation = 0;  // radians
  bool operator==(const TextureMapping&) const = default;
};
TextureMapping texture_mapping(const File& file, int material, TextureSlot slot);

// light.cpp. Lights of the nodes and of the side file, relative to `center`. Shapes that
// KHR_lights_punctual does not have stand in the light's extras.manylights: "shape" "capsule" or "box" on a
// point light, "wedge" on a spot; with "half_length" (m), or "half_extents" (m, along side, cross(direction,
// side), direction). The node's -z is the direction, its x the side; `range` is the window's radius (boxes
// have theirs from the extents). "probe" true makes it a probe light, of any shape. Other programs see points
// and spots.
void load_lights(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                 const glm::dvec3& center, Scene& scene);

// camera.cpp. One path per camera, relative to `center`; sets scene.near from the first. No path when
// there is no camera. After the meshes: what a camera reaches is measured at the level's bounds.
void load_cameras(File& file, const std::vector<PlacedNode>& nodes, const Movement& movement,
                  const glm::dvec3& center, Scene& scene);

// textures.cpp. Refuses images that no honest file holds, before memory is asked for; `pixels_left` is
// what may still be decoded.
void check_image_size(const File& file, const std::string& where, uint32_t width, uint32_t height,
                      size_t bytes, size_t pixels_left);
// stb.cpp, jpeg.cpp. To 8-bit RGBA; colour profiles are ignored, as glTF wants it. Throw
// UsageError.
Texture decode_png(const File& file, const std::string& where, Bytes bytes, size_t pixels_left);
bool is_jpeg(Bytes bytes);
Texture decode_jpeg(const File& file, const std::string& where, Bytes bytes, size_t pixels_left);
std::vector<std::byte> encode_png(const Texture& texture);

// tiny.cpp. tinygltf's Model of the checked description. Throws UsageError.
tinygltf::Model parse_model(const File& file);

// light_file.cpp: FILE.lights.bin, all little-endian: "MLLIGHTS", uint32 version (2), uint32 count, then
// for each light 92 bytes: double position[3] (m, relative to the level's origin), float radius (m), float
// intensity[3] (W/sr; probe lights: W/m^2), float direction[3], float inner_angle, float outer_angle
// (radians), uint32 shape (0 omni, 1 spot, 2 capsule, 3 wedge, 4 box; plus 2^31 for a probe light), float
// side[3], float half_length (m), float half_extents[3] (m). Version 1 is read too: 64 bytes a light, up to
// the shape, which is 0 or 1.
constexpr size_t max_file_lights = 1048576;
std::vector<std::byte> encode_lights(const std::vector<Light>& lights);
std::vector<Light> decode_lights(const std::string& name, Bytes bytes);

}  // namespace ml::gltf
