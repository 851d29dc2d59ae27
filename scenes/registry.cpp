#include <fmt/format.h>

#include <cmath>

#include "harness/base/error.h"
#include "harness/scene/scene.h"
#include "scenes/procedural.h"

namespace ml {

std::vector<SceneInfo> procedural_scenes() {
  return {
      {"canyon",
       "A valley with two forts, two tunnels, a bridge and rocks: 190 x 150 x 40 m, long and short views.",
       kCanyonLights},
      {"citadel",
       "A walled hill town with a keep, farms and woods: 760 x 760 x 100 m, streets and very long views.",
       kCitadelLights},
      {"grove",
       "A path between picket fences in a wood: 300 x 300 m, thin things before far ones in every tile.",
       kGroveLights},
      {"museum", "5 x 3 rooms of 14 m, closed all around; 80, 160 or 240 spots, capsules, wedges and boxes.",
       kMuseumLights},
      {"arena",
       "90 x 90 m with 450 objects; 50, 500, 2700 or 3240 lights in clumps, or 50 in one room of 12 x 12 m.",
       kArenaLights},
      {"plane", "Two triangles, 100 x 100 m: the number of lights per pixel has a closed form.",
       kPlaneLights}};
}

LightDefaults light_defaults(const SceneSpec& spec) {
  if (!spec.gltf.empty()) return {};
  for (const SceneInfo& info : procedural_scenes()) {
    if (info.name == spec.procedural) return info.lights;
  }
  return {};
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
  Scene scene;
  if (!spec.gltf.empty()) {
    scene = import_gltf(spec.gltf, spec.gltf_scene, spec.seed, spec.offset, spec.root);
  } else if (spec.procedural == "canyon") {
    scene = make_canyon(spec.seed);
  } else if (spec.procedural == "citadel") {
    scene = make_citadel(spec.seed);
  } else if (spec.procedural == "grove") {
    scene = make_grove(spec.seed);
  } else if (spec.procedural == "museum") {
    scene = make_museum(spec.seed);
  } else if (spec.procedural == "arena") {
    scene = make_arena(spec.seed);
  } else if (spec.procedural == "plane") {
    scene = make_plane();
  } else {
    std::vector<std::string> known;
    for (const SceneInfo& info : procedural_scenes()) known.push_back(info.name);
    throw UsageError(one_line(fmt::format("scene: unknown procedural scene '{}'{}", spec.procedural,
                                          suggestion(spec.procedural, known))));
  }
  // The vertices stay as they are: a level at 1e6 m has the same floats as one at 0.
  if (spec.gltf.empty()) scene.origin += spec.offset;
  if (spec.two_sided) {
    for (Material& material : scene.materials) material.double_sided = true;
  }
  return scene;
}

}  // namespace ml
