// The scenes of the bench: what each scene's folder brings, and all of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/description.h"

namespace ml {

struct SceneEntry {
  SceneDescription description;
  // A pure function of the seed; Scene::origin stays 0 (load_scene() moves it), and the scene ends as
  // finish_level() makes it.
  Scene (*make)(const SceneDescription& description, uint32_t seed);
};

// In the order of lists; a configuration that names no scene gets the first.
const std::vector<SceneEntry>& scene_registry();

// Null where there is no scene of that name.
const SceneEntry* find_scene(const std::string& name);

// Throws UsageError with the nearest known name.
const SceneDescription& describe_scene(const std::string& name);
Scene make_scene(const std::string& name, uint32_t seed = 1);

// Names in the order of lists.
std::vector<std::string> scene_names();

}  // namespace ml
