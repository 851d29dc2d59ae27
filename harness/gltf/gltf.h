// glTF files in and out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

// Reads a .gltf or .glb. A file without a camera gets automatic paths.
// `root`: the folder in or below which the file's buffers and textures must lie; empty: the file's own
// folder.
Scene import_gltf(const std::filesystem::path& file, int scene_index, uint32_t seed, const glm::dvec3& offset,
                  const std::filesystem::path& root = {});
// The same from memory, for tests and fuzzing; `name` stands in for the file name in errors, and external
// buffers are refused.
Scene import_gltf_memory(std::span<const std::byte> bytes, const std::string& name, int scene_index,
                         uint32_t seed, const glm::dvec3& offset);

// Writes scene, cameras (the keys of the default path as an animated camera) and lights (KHR_lights_punctual
// with extras for the shapes that it does not have, up to 4096; above that in a binary side file
// FILE.lights.bin named in the file's extras; formats: parts.h). Byte-identical on every machine. Throws
// SystemError, and UsageError for a scene without triangles and for a light that rejection_reason() refuses.
void export_glb(const Scene& scene, const std::vector<Light>& lights, const std::filesystem::path& file);

}  // namespace ml
