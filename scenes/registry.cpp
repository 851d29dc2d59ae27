// Every scene of the bench, in the order of lists. Adding one: its folder, its line here.
#include <fmt/format.h>

#include "harness/base/error.h"
#include "scenes/arena/arena.h"
#include "scenes/canyon/canyon.h"
#include "scenes/citadel/citadel.h"
#include "scenes/grove/grove.h"
#include "scenes/museum/museum.h"
#include "scenes/plane/plane.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

const SceneEntry& known_scene(const std::string& name) {
  if (const SceneEntry* entry = find_scene(name)) return *entry;
  throw UsageError(
      one_line(fmt::format("scene: unknown procedural scene '{}'{}", name, suggestion(name, scene_names()))));
}

}  // namespace

const std::vector<SceneEntry>& scene_registry() {
  static const std::vector<SceneEntry> entries{
      canyon_scene(), citadel_scene(), grove_scene(), museum_scene(), arena_scene(), plane_scene(),
  };
  return entries;
}

const SceneEntry* find_scene(const std::string& name) {
  for (const SceneEntry& entry : scene_registry()) {
    if (entry.description.name == name) return &entry;
  }
  return nullptr;
}

const SceneDescription& describe_scene(const std::string& name) {
  return known_scene(name).description;
}

Scene make_scene(const std::string& name, uint32_t seed) {
  const SceneEntry& entry = known_scene(name);
  return entry.make(entry.description, seed);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneEntry& entry : scene_registry()) names.push_back(entry.description.name);
  return names;
}

}  // namespace ml
