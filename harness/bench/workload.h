// What a setup of the configuration becomes on the CPU: scene, lights, camera path, effects. No Vulkan.
#pragma once

#include <memory>
#include <vector>

#include "harness/config/config.h"
#include "harness/frame/device_frame.h"
#include "harness/frame/frame_input.h"
#include "scenes/load_scene.h"

namespace ml {

class Workload {
 public:
  // Throws UsageError for scenes, paths and lights that cannot be had. `threads` is the number for prepare().
  // A `scene` that was loaded for the same SceneSpec before can be handed in again.
  Workload(const Setup& setup, unsigned threads, std::shared_ptr<const Scene> scene = nullptr);

  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  const LightSet& lights() const { return *lights_; }
  const CameraPath& path() const { return path_; }
  // What the content calls for, less what the configuration forces off.
  const FrameOptions& options() const { return options_; }
  FrameSequence& frames() { return *frames_; }

 private:
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<LightSet> lights_;
  CameraPath path_;
  FrameOptions options_;
  Threads threads_;
  std::unique_ptr<FrameSequence> frames_;
};

// Makes the workload of each setup once and lets it go: what cannot be had (UsageError) is known before any
// work starts. Returns the scene of the first one.
std::shared_ptr<const Scene> check_workloads(const std::vector<const Setup*>& setups);

}  // namespace ml
