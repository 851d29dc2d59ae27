// The 8x8 px blocks of the picture in which something is seen. Shading passes leave the others, the sky, out:
// on a GPU a workgroup of them ends at once, but a software device that runs its lanes in step takes it
// through every loop once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "harness/gpu/commands.h"
#include "harness/gpu/program.h"

namespace ml {

class OccupiedBlocks {
 public:
  OccupiedBlocks(gpu::Device& device, uint32_t width, uint32_t height);

  // Records the search after the g-buffer pass; `bindings` has its pictures.
  void record(gpu::Commands& commands, const gpu::Bindings& bindings);
  // When that has been done: takes what was found.
  void read();

  // Their positions (column, row), in the order in which they are to be shaded.
  std::span<const glm::u16vec2> positions() const { return positions_; }
  // The same as shading programs bind them ("Blocks"); to be transferred.
  const gpu::UploadBuffer& list() const { return list_; }

 private:
  uint32_t columns_;
  std::vector<uint32_t> rows_;  // in the order of shading
  gpu::ComputeProgram program_;
  gpu::Buffer found_, readback_;
  std::vector<glm::u16vec2> positions_;
  gpu::UploadBuffer list_;
};

}  // namespace ml
