// A scene on the device, and the pass that turns it into a g-buffer.
#pragma once

#include <memory>
#include <vector>

#include "harness/frame/targets.h"
#include "harness/gpu/commands.h"
#include "harness/scene/scene.h"

namespace ml {

class Level {
 public:
  // Uploads vertices, indices and textures. `alpha_mask` false: masked materials are drawn whole (effect
  // forced off). Throws SystemError when the device cannot hold the level.
  Level(gpu::Device& device, const Scene& scene, bool alpha_mask);

  // Draws everything into depth and surface; `view` is the frame's uniform buffer.
  void record_gbuffer(gpu::Commands& commands, const gpu::Buffer& view, const FrameTargets& targets) const;

  // Whether any material of the scene needs the alpha-masked program.
  static bool has_masked_material(const Scene& scene);

 private:
  gpu::Buffer vertices_, indices_;
  std::vector<gpu::Image> textures_;  // the last one is a white pixel
  std::unique_ptr<gpu::RasterProgram> opaque_, masked_;
  struct DrawItem {
    uint32_t first_index, index_count;
    bool double_sided, masked;
    size_t texture;
    std::vector<std::byte> push;
  };
  std::vector<DrawItem> items_;
};

}  // namespace ml
