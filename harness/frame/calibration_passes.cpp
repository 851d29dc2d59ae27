#include "harness/frame/calibration_passes.h"

#include <cstring>

#include "harness/frame/frame_input.h"
#include "spirv/calibrate_comp.h"

namespace ml {
namespace {

constexpr uint32_t threads = 1 << 16, group = 64, side = 512;
// Enough for about ten milliseconds on two cores of a software device.
constexpr uint32_t steps = 400;

// A dozen quads in front of one another, nearest last: every one of them is drawn.
Scene curtain() {
  Scene scene;
  scene.name = "calibration";
  scene.materials.push_back({});
  for (uint32_t i = 0; i < 12; ++i) {
    float z = -200.0f + static_cast<float>(i);
    auto first = static_cast<uint32_t>(scene.vertices.size());
    for (glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
      scene.vertices.push_back({{corner * 300.0f, z}, {0, 0, 1}, {0, 0}});
    for (uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first + index);
  }
  scene.draws.push_back({0, static_cast<uint32_t>(scene.indices.size()), 0});
  return scene;
}

}  // namespace

CalibrationPasses::CalibrationPasses(gpu::Device& device)
    : device_(device),
      commands_(device),
      compute_(device, calibrate_comp, "calibration"),
      sink_(device, threads * sizeof(uint32_t), gpu::MemoryKind::device, "calibration"),
      level_(device, curtain(), FrameOptions{.many_lights = false}),
      targets_(device, side, side),
      view_(device, sizeof(gpu_data::ViewData), gpu::MemoryKind::upload, "calibration view") {
  Camera camera;
  camera.projection = Projection::perspective(1.0f, 1.0f, 0.1f, 300.0f);
  gpu_data::ViewData view = view_data(camera, side, side, 0);
  std::memcpy(view_.mapped().data(), &view, sizeof view);
}

gpu::SubmissionTimes CalibrationPasses::run(const std::vector<Kind>& order) {
  commands_.begin(gpu::Timing::stages);
  for (size_t i = 0; i < order.size(); ++i) {
    auto span = commands_.span(std::to_string(i));
    if (order[i] == Kind::raster)
      level_.record_gbuffer(commands_, view_, targets_);
    else
      commands_.dispatch(compute_, {{"Sink", sink_}}, steps, threads / group);
  }
  return commands_.submit();
}

}  // namespace ml
