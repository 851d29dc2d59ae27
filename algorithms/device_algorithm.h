// The device half of an algorithm: what it records on the GPU, beside the shading loop that the harness has
// for all or in its place.
//
// A frame of it is build() (lists, made by dispatches alone) and shade(). The base class builds nothing and
// shades by the harness's loop with the algorithm's light cursor, so most algorithms need none of their own.
// Who has passes of his own declares them: AlgorithmInfo names passes and counters, images() what is kept or
// shown.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/algorithm.h"
#include "harness/gpu/commands.h"

namespace ml {

struct DeviceContext {
  gpu::Device& device;           // outlives the algorithm
  const gpu::Constants& shared;  // the harness's constants (shaders/constants.glsl), offered to any program
  bool has(std::string_view constant) const;  // whether one of them is not 0: has("EFFECT_PROBES")
};

// An image of the algorithm's own, of the picture's resolution; passes bind it by its name.
struct OwnImage {
  std::string name;  // as shaders call it
  std::string help;  // one line
  gpu::Format format;
  // Kept from frame to frame: there are two that change places with each next frame, and the one that the
  // frame before left is bound as NAME + "Before". Both are 0 in a first frame.
  bool history = false;
};

// Frame totals or means by the names that AlgorithmInfo::counters declares.
using CounterValues = std::map<std::string, double>;

// What a pass may bind, and where it says what later ones may.
class FrameResources {
 public:
  virtual ~FrameResources() = default;
  // The frame's View, Depth, Surface, Lights, Extras and Result, the algorithm's upload buffers, its images,
  // what it published, and in a counting lap the counters. A name that a program asks for and that is not
  // there is refused (std::logic_error); nothing stands in for it.
  virtual const gpu::Bindings& bindings() const = 0;
  // Bound from here on in this frame, by the shading loop too. The buffer outlives the frame.
  virtual void publish(std::string_view name, const gpu::Buffer& buffer) = 0;
  // The harness's loop with the algorithm's cursor, into Result: passes `shade`, `composite` and `forward`.
  virtual void shading_loop() = 0;
};

enum class ShadeVariant { timed, counting };

class DeviceAlgorithm {
 public:
  virtual ~DeviceAlgorithm() = default;

  // The same for every frame.
  virtual std::vector<OwnImage> images() const { return {}; }

  // Records what comes before shading, of the frame that prepare() saw last, each pass in a span of a
  // declared name. Dispatches alone: they may run on a queue that knows no graphics, beside other work
  // (gpu::Commands::fork).
  virtual void build(gpu::Commands&, const FrameInput&, FrameResources&) {}
  // Records shading. All pixels that see something get a value in Result; others are left alone.
  virtual void shade(gpu::Commands&, const FrameInput&, FrameResources& resources, ShadeVariant) {
    resources.shading_loop();
  }
  // After a counting lap: reads back, in submissions of its own, what PrepareCounters and the declared
  // counters cannot know without the GPU.
  virtual void read_counters(gpu::Commands&, PrepareCounters&, CounterValues&) {}
  // As Algorithm::lights_listed(), for lists that the device made, of the frame that was read back last.
  virtual std::optional<uint32_t> lights_listed(glm::uvec2 /*pixel*/) const { return std::nullopt; }
  // Bytes of its buffers and images, as allocated; those of images() apart.
  virtual uint64_t bytes() const { return 0; }
};

}  // namespace ml
