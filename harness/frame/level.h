// A scene on the device, and the pass that turns it into a g-buffer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "harness/frame/frame_options.h"
#include "harness/frame/level_textures.h"
#include "harness/frame/targets.h"
#include "harness/gpu/commands.h"
#include "harness/scene/draw_motion.h"
#include "harness/scene/scene.h"

namespace ml {

class Level {
 public:
  // Uploads vertices, indices and textures into the device's own memory. Effects that are off: masked
  // materials are drawn whole, forward ones like any others, materials without vertex colours,
  // metallic-roughness and normal textures, surfaces give no light; without shadow maps record_depth() will
  // not be asked for. Throws SystemError when the device cannot hold the level, or cannot draw forward
  // materials.
  Level(gpu::Device& device, const Scene& scene, const FrameOptions& options);

  // A program of the forward pass; `fragment` is ShadeShaders::forward or its counting variant.
  static gpu::RasterProgram forward_program(gpu::Device& device, std::span<const uint32_t> fragment,
                                            const std::string& name, const FrameOptions& options,
                                            const gpu::Constants& constants);
  // Draws what is lit forward into the result, over what is there; `bindings` is what the shading loop binds.
  void record_forward(gpu::Commands& commands, const gpu::RasterProgram& program,
                      const gpu::Bindings& bindings, const FrameTargets& targets) const;

  // Where moving meshes are from now on; `time` as in FrameInput.
  void move_to(double time);

  // Draws everything into depth, surface and (where there are any) forward and emission; `view` is the
  // frame's uniform buffer.
  void record_gbuffer(gpu::Commands& commands, const gpu::Buffer& view, const FrameTargets& targets) const;

  // Draws everything into a depth picture alone, as `view` sees it.
  void record_depth(gpu::Commands& commands, const gpu::Buffer& view, const gpu::Image& depth) const;

 private:
  gpu::Commands commands_;  // for uploading
  gpu::Buffer vertices_, indices_;
  std::optional<gpu::Buffer> details_;  // of vertices: where programs ask for them
  LevelTextures textures_;
  std::unique_ptr<gpu::RasterProgram> opaque_, masked_, depth_opaque_, depth_masked_;
  struct DrawItem {
    uint32_t first_index, index_count;
    bool double_sided, masked, forward;
    const gpu::Image *base_color, *metallic_roughness, *normal_map, *emission_map;
    std::vector<std::byte> push;
    std::optional<DrawMotion> motion = std::nullopt;
    bool seen = true;
    bool mirrored = false;  // in this frame
  };
  std::vector<DrawItem> items_;
  std::shared_ptr<const NodeMotions> motions_;  // null where no mesh moves
  glm::dvec3 motion_center_{0};

  static void set_pose(DrawItem& item, const DrawPose& pose);

  // A draw of the item by the program that fits it, with what belongs to the mesh bound.
  gpu::DrawCall call_of(const DrawItem& item, const gpu::RasterProgram& program) const;
};

}  // namespace ml
