// From what a configuration says to the level: a procedural scene or a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "harness/scene/scene.h"

namespace ml {

// What a configuration's "scene" says: a procedural scene or a glTF/GLB file.
struct SceneSpec {
  std::string procedural;      // name, or empty
  std::filesystem::path gltf;  // file, or empty
  // The folder in or below which the file's buffers and textures must lie, so that a level cannot read what
  // is none of its business; empty: the file's own folder.
  std::filesystem::path root;
  int gltf_scene = -1;  // which of the file's scenes; -1 is the file's default
  uint32_t seed = 1;    // procedural generation and automatic camera paths
  glm::dvec3 offset{
      0};  // m, added to the whole level in double: the far-from-origin test; |component| <= 1e9
  bool two_sided =
      false;  // every material is drawn from both sides: for levels whose winding is not reliable
  // Of the same level.
  bool operator==(const SceneSpec&) const = default;
};

// The light defaults of the scene that load_scene(spec) gives, without making it.
LightDefaults light_defaults(const SceneSpec& spec);

// Throws UsageError (unknown name, bad file) with one line that names the file and the place in it.
Scene load_scene(const SceneSpec& spec);

}  // namespace ml
