// The textures of a level on the device, as its materials take them.
#pragma once

#include <map>
#include <tuple>

#include "harness/gpu/commands.h"
#include "harness/scene/scene.h"

namespace ml {

class LevelTextures {
 public:
  enum class Use {
    color,  // sRGB
    data,   // linear
  };
  // The scene's texture of that index, a white pixel for -1. It is uploaded when it is first asked for, and
  // stays where it is.
  const gpu::Image& get(gpu::Device& device, gpu::Commands& commands, const Scene& scene, int texture,
                        Use use);

 private:
  std::map<std::tuple<int, Use>, gpu::Image> images_;
};

}  // namespace ml
