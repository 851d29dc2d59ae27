// Depth-only pictures of the level from its lights: the work beside which lists are built. They are drawn and
// read by nothing; what they cost is what they are for.
#pragma once

#include <vector>

#include "harness/frame/level.h"

namespace ml {

struct FrameInput;

class ShadowMaps {
 public:
  // `count` square maps of `size` px. Throws SystemError when the device cannot hold them.
  ShadowMaps(gpu::Device& device, uint32_t count, uint32_t size);
  // The views of the frame (shadow_views).
  void load(const FrameInput& input);
  // All maps in one span, "shadow_maps".
  void record(gpu::Commands& commands, const Level& level) const;

  const std::vector<gpu::Image>& maps() const { return maps_; }
  uint64_t bytes() const;

 private:
  uint32_t size_;
  std::vector<gpu::Image> maps_;
  std::vector<gpu::Buffer> views_;
};

}  // namespace ml
