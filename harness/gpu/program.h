// Compute and raster programs, compiled for the values of their specialization constants. A device keeps what
// it compiled: the same modules with the same constants and state are compiled once, so a sweep's points
// share their programs. Their descriptor layouts come from reflection of the SPIR-V, so a pass names what it
// binds. A texel buffer (usamplerBuffer) with the name of a buffer and "Quads" appended shows that buffer's
// words, four a texel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/gpu/constant.h"
#include "harness/gpu/device.h"
#include "harness/gpu/resources.h"

namespace ml::gpu {

class ComputeProgram {
 public:
  // Throws SystemError when the device refuses the module.
  ComputeProgram(Device& device, std::span<const uint32_t> spirv, const std::string& name,
                 const Constants& constants = {});
  ~ComputeProgram();
  ComputeProgram(ComputeProgram&&) noexcept;
  ComputeProgram& operator=(ComputeProgram&&) noexcept;
  const std::string& name() const { return name_; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::string name_;
  std::shared_ptr<Impl> impl_;  // shared by equal programs; nothing in it changes once it is made
};

struct VertexAttribute {
  uint32_t offset;      // bytes in the vertex
  uint32_t components;  // floats, 2 or 3
};

struct RasterState {
  std::vector<Format> colors;
  Format depth = Format::d32_float;
  uint32_t vertex_stride = 0;
  std::vector<VertexAttribute> attributes;  // location = position in this list
  // False: nearer triangles pass and leave their depth. True: only what lies at the depth that is there
  // passes.
  bool at_equal_depth = false;
};

// Triangles with reversed depth; cull mode and front face are set per draw. An empty `fragment`: depth alone.
class RasterProgram {
 public:
  RasterProgram(Device& device, std::span<const uint32_t> vertex, std::span<const uint32_t> fragment,
                const std::string& name, const RasterState& state, const Constants& constants = {});
  ~RasterProgram();
  RasterProgram(RasterProgram&&) noexcept;
  RasterProgram& operator=(RasterProgram&&) noexcept;
  const std::string& name() const { return name_; }

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::string name_;
  std::shared_ptr<Impl> impl_;  // shared by equal programs; nothing in it changes once it is made
};

}  // namespace ml::gpu
