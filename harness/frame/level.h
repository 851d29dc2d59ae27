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
  // Uploads vertices, indices and textures. `alpha_mask` false: masked materials are drawn whole; `forward`
  // false: forward materials are like any others (effects forced off); `shadows`: record_depth() will be
  // asked for; `clip_far`: views may have a clip_far. Throws SystemError when the device cannot hold the
  // level, or cannot draw forward materials.
  Level(gpu::Device& device, const Scene& scene, bool alpha_mask, bool forward = false, bool shadows = false,
        bool clip_far = false);

  // A program of the forward pass; `fragment` is ShadeShaders::forward or its counting twin.
  static gpu::RasterProgram forward_program(gpu::Device& device, std::span<const uint32_t> fragment,
                                            const std::string& name,
                                            const std::vector<gpu::Constant>& constants);
  // Draws what is lit forward into the result, over what is there; `bindings` is what the shading loop binds.
  void record_forward(gpu::Commands& commands, const gpu::RasterProgram& program,
                      const gpu::Bindings& bindings, const FrameTargets& targets) const;

  // Draws everything into depth, surface and (where there is one) forward; `view` is the frame's uniform
  // buffer.
  void record_gbuffer(gpu::Commands& commands, const gpu::Buffer& view, const FrameTargets& targets) const;

  // Draws everything into a depth picture alone, as `view` sees it.
  void record_depth(gpu::Commands& commands, const gpu::Buffer& view, const gpu::Image& depth) const;

  // Whether any material of the scene needs the alpha-masked program.
  static bool has_masked_material(const Scene& scene);
  // Whether any triangle of the scene is to be lit forward.
  static bool has_forward_material(const Scene& scene);

 private:
  gpu::Buffer vertices_, indices_;
  std::vector<gpu::Image> textures_;  // the last one is a white pixel
  std::unique_ptr<gpu::RasterProgram> opaque_, masked_, depth_opaque_, depth_masked_;
  struct DrawItem {
    uint32_t first_index, index_count;
    bool double_sided, masked, forward;
    size_t texture;
    std::vector<std::byte> push;
  };
  std::vector<DrawItem> items_;

  // A draw of the item by the program that fits it, nothing bound yet.
  static gpu::DrawCall call_of(const DrawItem& item, const gpu::RasterProgram& program);
};

}  // namespace ml
