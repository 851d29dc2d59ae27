#include <algorithm>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/camera/automatic_path.h"
#include "harness/gltf/gltf.h"
#include "harness/gltf/parts.h"
#include "harness/scene/draw_motion.h"

namespace ml {
namespace {

using gltf::File;
using gltf::Json;

constexpr size_t max_description = size_t{256} << 20;  // bytes of JSON

Json parse_json(const File& file, std::string_view text) {
  if (text.size() > max_description) file.fail("JSON", "is larger than 256 MiB");
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // nlohmann's messages begin with its own name in brackets.
    std::string what = error.what();
    size_t start = what.find("] ");
    file.fail("JSON", start == std::string::npos ? what : what.substr(start + 2));
  }
}

double distance_range(const Scene& scene) {
  return std::max(glm::length(glm::dvec3(scene.bounds.size())), 10.0 * double{scene.near});
}

Scene build(File& file, gltf::Bytes bytes, int scene_index, uint32_t seed, const glm::dvec3& offset) {
  gltf::Container container = gltf::open_container(file, bytes);
  {
    Json raw = parse_json(file, container.json);
    gltf::check_version_and_extensions(file, raw);
    file.json = gltf::checked_description(file, raw);
    gltf::note_what_is_ignored(file, raw);
    gltf::note_unknown_extensions(file, raw);
  }
  file.model = gltf::parse_model(file);
  gltf::load_buffers(file, container.binary);
  std::vector<gltf::PlacedNode> nodes = gltf::place_nodes(file, scene_index);

  // What the bench's exporter says about a level that it wrote: then the file's zero is the level's origin.
  Json own = file.json.value("/asset/extras/manylights"_json_pointer, Json::object());
  glm::dvec3 written_origin(0), zero(0);
  for (int c = 0; own.contains("origin") && c < 3; ++c) {
    written_origin[c] = own["origin"][static_cast<size_t>(c)];
    if (!(std::abs(written_origin[c]) <= 4 * gltf::max_coordinate))
      file.fail("asset.extras.manylights.origin", "expected at most 4e9 m");
  }

  const gltf::Movement movement = gltf::load_movement(file, nodes);

  Scene scene;
  scene.motions = movement.motions;
  scene.name = own.value("name", std::filesystem::path(file.name).stem().string());
  gltf::load_materials(file, scene);
  glm::dvec3 center =
      gltf::load_meshes(file, nodes, movement, own.contains("origin") ? &zero : nullptr, scene);
  scene.motion_center = center;
  finish_motion(scene);
  scene.origin = offset + center + written_origin;
  gltf::load_lights(file, nodes, movement, center, scene);
  gltf::load_cameras(file, nodes, movement, center, scene);
  if (own.contains("near")) scene.near = own["near"].get<float>();
  scene.far = own.contains("far") ? own["far"].get<float>() : static_cast<float>(distance_range(scene));
  if (!(scene.near > 0 && scene.far > scene.near))
    file.fail("asset.extras.manylights", "expected 0 < near < far");
  if (scene.paths.empty()) {
    // Nobody says where the near plane is: in a level of centimetres a tenth of a metre is beyond it.
    if (!own.contains("near") && !scene.indices.empty())
      scene.near = std::clamp(static_cast<float>(0.01 * glm::length(glm::dvec3(scene.bounds.size()))), 1e-6f,
                              scene.near);
    scene.paths.push_back(automatic_path(scene, seed));
    scene.paths[0].name = "default";
  }
  scene.notes.insert(scene.notes.end(), file.notes.begin(), file.notes.end());
  return scene;
}

Scene build_or_explain(File& file, gltf::Bytes bytes, int scene_index, uint32_t seed,
                       const glm::dvec3& offset) {
  try {
    return build(file, bytes, scene_index, seed, offset);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw UsageError(file.name + ": needs more memory than there is");
  } catch (const std::exception& error) {
    throw UsageError(file.name + ": cannot be read: " + error.what());
  }
}

}  // namespace

Scene import_gltf(const std::filesystem::path& path, int scene_index, uint32_t seed, const glm::dvec3& offset,
                  const std::filesystem::path& root) {
  std::vector<std::byte> bytes = read_file(path);
  File file;
  file.name = path.string();
  file.folder = path.parent_path();
  file.root = root.empty() ? file.folder : root;
  file.external = true;
  return build_or_explain(file, bytes, scene_index, seed, offset);
}

Scene import_gltf_memory(std::span<const std::byte> bytes, const std::string& name, int scene_index,
                         uint32_t seed, const glm::dvec3& offset) {
  File file;
  file.name = name;
  return build_or_explain(file, bytes, scene_index, seed, offset);
}

}  // namespace ml
