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

bool same_scene(const SceneSpec& a, const SceneSpec& b) {
  return a.procedural == b.procedural && a.gltf == b.gltf && a.gltf_scene == b.gltf_scene &&
         a.seed == b.seed && a.offset == b.offset && a.two_sided == b.two_sided;
}

std::shared_ptr<const Scene> check_workloads(const std::vector<const Setup*>& setups) {
  std::shared_ptr<const Scene> first, scene;
  const Setup* before = nullptr;
  for (const Setup* setup : setups) {
    if (before && !same_scene(before->scene, setup->scene)) scene = nullptr;
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
  auto has = [this](LightShape shape) {
    return std::any_of(lights_->base().begin(), lights_->base().end(),
                       [shape](const Light& light) { return light.shape == shape; });
  };
  effects_.spots = setup.effects.spots && has(LightShape::spot);
  effects_.capsules = setup.effects.capsules && has(LightShape::capsule);
  effects_.wedges = setup.effects.wedges && has(LightShape::wedge);
  effects_.boxes = setup.effects.boxes && has(LightShape::box);
  effects_.probes = setup.effects.probes && std::any_of(lights_->base().begin(), lights_->base().end(),
                                                        [](const Light& light) { return light.probe; });
  effects_.specular = setup.effects.specular;
  effects_.long_lists = lights_->base().size() > max_lights_of_short_passes;
  effects_.alpha_mask = setup.effects.alpha_mask && Level::has_masked_material(*scene_);
  effects_.forward = setup.effects.forward && Level::has_forward_material(*scene_);
  effects_.clip_far = path_.clips_far;
  effects_.motion = !scene_->draw_motions.empty();
  effects_.material_detail = setup.effects.material_detail && Level::has_material_detail(*scene_);
  effects_.emission = setup.effects.emission && Level::has_emission(*scene_);
  effects_.split_targets = setup.shading.targets == ShadingTargets::split;
  effects_.shadow_maps = setup.shading.shadow_maps;
  effects_.shadow_map_size = setup.shading.shadow_map_size;
  effects_.compute_lists = setup.shading.list_queue == ListQueue::compute;
  if (setup.shading.light_fetch != LightFetch::automatic)
    effects_.texel_fetch = setup.shading.light_fetch == LightFetch::texel;
  effects_.test_ahead = setup.shading.test_ahead;
  frames_ = std::make_unique<FrameSequence>(*scene_, *lights_, path_, setup.camera.frames, setup.width,
                                            setup.height, threads_, effects_.shapes());
}

}  // namespace ml
