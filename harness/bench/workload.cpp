#include "harness/bench/workload.h"

#include <algorithm>

#include "harness/frame/shading_loops.h"
#include "scenes/load_scene.h"

namespace ml {
namespace {

// Keyframes are in the file's own world; the path is relative to the scene's origin.
CameraPath path_of(const CameraSpec& spec, const Scene& scene) {
  if (spec.keyframes.empty()) return scene.path(spec.path);
  CameraPath path;
  path.name = "keyframes";
  path.keys = spec.keyframes;
  for (CameraKey& key : path.keys) {
    key.position -= scene.origin;
    key.target -= scene.origin;
  }
  return path;
}

}  // namespace

std::shared_ptr<const Scene> check_workloads(const std::vector<const Setup*>& setups) {
  std::shared_ptr<const Scene> first, scene;
  const Setup* before = nullptr;
  for (const Setup* setup : setups) {
    if (before && !(before->scene == setup->scene)) scene = nullptr;
    scene = Workload(*setup, 1, scene).scene();
    before = setup;
    if (!first) first = scene;
  }
  return first;
}

Workload::Workload(const Setup& setup, unsigned threads, std::shared_ptr<const Scene> scene)
    : scene_(scene ? std::move(scene) : std::make_shared<const Scene>(load_scene(setup.scene))),
      lights_(std::make_unique<LightSet>(setup.lights, *scene_)),
      path_(path_of(setup.camera, *scene_)),
      threads_(threads) {
  options_.effects = effects_of({*scene_, lights_->base(), path_}, setup.effects);
  options_.many_lights = lights_->base().size() > max_lights_of_short_passes;
  options_.shading.split_targets = setup.shading.targets == ShadingTargets::split;
  options_.shading.shadow_maps = setup.shading.shadow_maps;
  options_.shading.shadow_map_size = setup.shading.shadow_map_size;
  options_.shading.compute_lists = setup.shading.list_queue == ListQueue::compute;
  if (setup.shading.light_fetch != LightFetch::automatic)
    options_.shading.texel_fetch = setup.shading.light_fetch == LightFetch::texel;
  options_.shading.test_ahead = setup.shading.test_ahead;
  frames_ = std::make_unique<FrameSequence>(*scene_, *lights_, path_, setup.camera.frames, setup.width,
                                            setup.height, threads_, options_.effects.shapes());
}

}  // namespace ml
