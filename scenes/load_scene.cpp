#include "scenes/load_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/gltf/gltf.h"
#include "scenes/scene_registry.h"

namespace ml {

LightDefaults light_defaults(const SceneSpec& spec) {
  if (!spec.gltf.empty()) return {};
  const SceneEntry* entry = find_scene(spec.procedural);
  return entry ? entry->description.lights : LightDefaults();
}

Scene load_scene(const SceneSpec& spec) {
  if (spec.procedural.empty() == spec.gltf.empty()) {
    throw UsageError("scene: expected either the name of a procedural scene or a glTF file");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(spec.offset[axis]) <= 1e9)) {
      throw UsageError(fmt::format("scene: offset {} is {}, expected a number within +-1e9 m", "xyz"[axis],
                                   spec.offset[axis]));
    }
  }
  Scene scene = spec.gltf.empty()
                    ? make_scene(spec.procedural, spec.seed)
                    : import_gltf(spec.gltf, spec.gltf_scene, spec.seed, spec.offset, spec.root);
  // The vertices stay as they are: a level at 1e6 m has the same floats as one at 0.
  if (spec.gltf.empty()) scene.origin += spec.offset;
  if (spec.two_sided) {
    for (Material& material : scene.materials) material.double_sided = true;
  }
  return scene;
}

}  // namespace ml
