// What one frame is made of, on the CPU: the camera's view and the lights, camera-relative. No Vulkan:
// prepare() is tested and benchmarked on exactly what a run gives it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/algorithm.h"
#include "harness/lights/set.h"
#include "harness/scene/camera.h"
#include "harness/scene/scene.h"

namespace ml {

gpu_data::ViewData view_data(const Camera& camera, uint32_t width, uint32_t height, uint32_t light_count);

// A bit for each LightShape, and one for probe lights.
inline constexpr uint32_t probe_lights_bit = 32, all_light_shapes = 63;

// Fills structure-of-arrays storage from lights; reused from frame to frame.
class FrameLightStorage {
 public:
  // `camera` as in Camera::position. Lights must have passed rejection_reason(); at most 2^23 of them.
  // `shapes`: a bit for each LightShape; lights of a shape that is off are omni lights of their radius.
  // Without probe_lights_bit probe lights are direct ones.
  void fill(const std::vector<Light>& lights, const glm::vec3& camera, uint32_t shapes = all_light_shapes);
  FrameLights lights() const;

 private:
  size_t count_ = 0;
  std::vector<float> x_, y_, z_, radius_;  // with padding after the last light
  std::vector<gpu_data::LightCore> core_;
  std::vector<gpu_data::LightExtra> extra_;
};

// The frames of one setup: scene, lights and camera path at one resolution.
class FrameSequence {
 public:
  // The scene, the lights and the threads must outlive the sequence.
  FrameSequence(const Scene& scene, const LightSet& lights, const CameraPath& path, uint32_t frames,
                uint32_t width, uint32_t height, Threads& threads, uint32_t shapes = all_light_shapes);

  // The input of a frame, 0 <= index < frames(); valid until the next call.
  const FrameInput& at(uint32_t index);

  uint32_t frames() const { return frames_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  const Camera& camera() const { return camera_; }
  const std::vector<Light>& scene_lights() const { return active_; }

 private:
  const Scene& scene_;
  const LightSet& set_;
  const CameraPath& path_;
  uint32_t frames_, width_, height_, shapes_;
  Camera camera_;
  std::vector<Light> active_;
  std::vector<uint32_t> identity_;
  FrameLightStorage storage_;
  FrameInput input_;
  bool seen_ = false;  // a frame was asked for
};

}  // namespace ml
