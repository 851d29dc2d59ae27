// The one interface behind which every many-light algorithm runs.
//
// A frame is prepare() on the CPU, then build() and shade() of the device half (device_algorithm.h).
// prepare() sees no Vulkan and writes plain memory that the caller lends, so that it can be tested and
// benchmarked without a device. What an algorithm does not bring is the harness's: nothing is built on the
// device, and shading is one loop into which it puts its light cursor (`light_cursor.glsl` in its folder), so
// that times differ by how lights are found and by nothing else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/parameters.h"
#include "harness/base/parallel.h"
#include "harness/base/spans.h"
#include "harness/gpu/constant.h"
#include "shaders/shared/light.h"
#include "shaders/shared/view.h"

namespace ml {

class DeviceAlgorithm;
struct DeviceContext;
struct FrameTargets;  // harness/frame/targets.h: g-buffer and result of one resolution
struct ContributingLists;

// What a pass is for; sums over passes and `eff.` go by it.
enum class PassKind : uint8_t {
  lists,    // finds lights: build()
  shading,  // brings light to pixels, as the harness's passes `shade`, `composite` and `forward` do
  post,     // works on the finished picture
};
const char* word_of(PassKind kind);
struct PassInfo {
  std::string name;
  PassKind kind = PassKind::lists;
};

struct CounterInfo {
  std::string name;  // as the result has it
  std::string help;  // one line, with the unit
  // The counting variant of the cursor writes it to a uimage2D (r32ui) of this name, one number a pixel: the
  // result has the mean over lit pixels, and there is a heat map. Else the device half reads it back.
  bool per_pixel = false;
};

struct AlgorithmInfo {
  std::string name;
  std::string summary;  // one line
  std::string paper;    // author, title, year; "" for the reference algorithms
  bool exact = true;    // false: stochastic
  uint32_t max_lights =
      0;  // more lights than this are a configuration error; 0: no limit of its own (23-bit ids)
  bool needs_contributing_lists = false;  // `ideal`: wants the per-pixel lists of contributing lights
  bool reference_only = false;            // too slow for ordinary runs: left out of "all"
  // Span names that prepare() writes, in order.
  std::vector<std::string> cpu_stages;
  // Passes that its device half records under these names, in order; the shading loop's own are not among
  // them.
  std::vector<PassInfo> passes;
  bool builds_on_gpu() const {
    return std::ranges::any_of(passes, [](const PassInfo& pass) { return pass.kind == PassKind::lists; });
  }
  // Counters of its own, beside those that all have.
  std::vector<CounterInfo> counters;
  std::vector<std::string> shapes{"omni", "spot", "capsule", "wedge", "box"};  // light shapes it bounds
};

// The lights of one frame, camera-relative (world axes), rounded to float once and the same for CPU and GPU.
// Structure of arrays, so that bounds can be computed many at a time; all spans have the same length and 64
// readable bytes of padding after their last element.
struct FrameLights {
  std::span<const float> x, y, z;  // m
  // m, > 0: of the ball around (x, y, z) that holds the light's whole volume, so that an algorithm that knows
  // balls alone loses nothing. The window's radius is core's; for omni lights and spots they are the same.
  std::span<const float> radius;
  std::span<const gpu_data::LightCore> core;  // the same lights as the GPU has them
  // What shapes other than omni need (axes, cone, length, extents; bound_radius is `radius` above); same
  // length as core, or empty when all lights are omni. Fields: shaders/shared/light.h.
  std::span<const gpu_data::LightExtra> extra;
  // Which of the scene's lights each is: a light has the same number, below 2^23, in every frame in which it
  // shines. Ascending. Empty: light i is number i.
  std::span<const uint32_t> identity;
  size_t count() const { return x.size(); }
};

// How a frame follows on the one that the algorithm saw before it. Nobody compares frame numbers.
enum class Step : uint8_t {
  first,  // on none: the first of a lap, or after a camera that jumped; what is kept must not be used
  next,   // it is the next
  same,   // it is the same once more
};

// What prepare() sees.
struct FrameInput {
  uint32_t index = 0;  // frame number in the camera path
  Step step = Step::first;
  double time = 0;  // s, of the clock by which the level's nodes move (NodeMotions)
  gpu_data::ViewData view;
  gpu_data::ViewData previous_view;  // of the frame before; after a cut, and where there is none, `view`
  FrameLights lights;
  Threads* threads = nullptr;  // never null in prepare()
};

// Memory that prepare() fills and the GPU reads. Slots are the algorithm's own small numbers from 0, in the
// order of Algorithm::buffers().
class UploadMemory {
 public:
  virtual ~UploadMemory() = default;
  // Every slot is mapped by every prepare(), one that holds nothing with 0 bytes.
  // At least `bytes` writable bytes, 64-byte aligned; contents undefined. Valid until the next prepare().
  // Where the slot is cached(), mapping it again with fewer bytes keeps address and contents. Grows rarely
  // and never shrinks. Throws SystemError, naming algorithm, slot and limit, when the device cannot hold it.
  virtual std::span<std::byte> map(uint32_t slot, size_t bytes) = 0;
  // The most bytes that one slot can hold.
  virtual size_t limit() const = 0;
  // Whether a slot that was mapped is ordinary cached memory, that can be written in any order and read back;
  // else it has to be written once, from front to back.
  virtual bool cached(uint32_t) const { return false; }
};

// Exact numbers of one prepare().
struct PrepareCounters {
  uint64_t in_frustum = 0;  // lights left after culling against the view
  uint64_t list_bytes = 0;  // bytes of the structures that the GPU reads, light data apart unless duplicated
  uint64_t list_cells = 0,
           tree_cells = 0;  // cells with lights that hold a list, a tree; 0 where there are no trees
  uint64_t overflow_tiles = 0,
           overflow_lights = 0;  // demand beyond the algorithm's caps; 0 for lossless ones
  // Lists built on the GPU, known after a counting lap (Algorithm::read_counters): lights in a tile's list,
  // means over all tiles, before and after fine pruning.
  double coarse_lights = 0, fine_lights = 0;
};

// A SPIR-V module that the build put into the program.
using Spirv = std::span<const uint32_t>;

// The shading loop compiled with the algorithm's light cursor (ml_shading_loop in CMakeLists.txt).
struct ShadeShaders {
  Spirv timed;     // nothing but the picture
  Spirv counting;  // writes the counters too
  // The same as fragment shaders of the forward pass.
  Spirv forward, forward_counting;
};

// A class for each tile of a picture: `of_tile`[row * columns + column], at most `max`. No tiles: all are of
// class `max`.
struct TileClasses {
  uint32_t max = 0;
  uint32_t tile = 0, columns = 0;  // px, tiles
  std::span<const uint8_t> of_tile;
};

// What a pixel looks at on its way through a list or a tree. light_next() takes a light or a node a call, or
// both.
struct LongestWalk {
  uint64_t lights = 0, nodes = 0;
  // Subtrees of 64 leaves that a subgroup takes one after the other, where that is how it walks together
  // (algorithms/trees/masked_walk.glsl); else 0.
  uint64_t subtrees = 0;
};

class Algorithm {
 public:
  virtual ~Algorithm() = default;

  // CPU only. Reuses its memory from frame to frame; the same input gives the same bytes for any number of
  // threads.
  virtual void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) = 0;
  virtual PrepareCounters counters() const = 0;

  // Names of the storage buffers behind the upload slots, as the shaders call them.
  virtual std::vector<std::string> buffers() const = 0;
  virtual ShadeShaders shade_shaders() const = 0;
  // Values of the cursor's own specialization constants (constant_id from 32).
  virtual gpu::Constants shade_constants() const { return {}; }

  // No less than any pixel looks at in the frame that prepare() saw last. The shading loop is chosen by it
  // (harness/frame/shading_loops.h). Default: every light of the frame.
  virtual LongestWalk longest_walk(const FrameInput& frame) const { return {frame.lights.count(), 0}; }
  // The cursor is brute force's: it looks at the lights [first_light, end_light) of the push constant alone,
  // in their order, so that a frame of very many lights is shaded by several dispatches.
  virtual bool walks_ranges() const { return false; }

  // The classes of the picture's tiles in the frame that prepare() saw last, where some need less of the
  // shading loop than others. Each class is shaded by a program of its own, for what a program can do costs
  // time also where it is not needed.
  virtual TileClasses tile_classes() const { return {}; }
  // Further constants of a class's program. A higher class can do what a lower one can; the highest is
  // `TileClasses::max`.
  virtual gpu::Constants class_constants(uint32_t /*tile_class*/) const { return {}; }

  // The pixels of a subgroup walk their cells' lights together, where the device can (shade.comp:
  // CURSOR_RUNS).
  virtual bool walks_together() const { return false; }

  // What it records on the device (device_algorithm.h); made once, before the first frame, and outlived by
  // the algorithm. Default: the harness's shading loop and nothing else.
  virtual std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context);

  // How many lights the list or the tree holds that a surface point at this pixel and view depth (m) looks
  // through, in the frame that was counted last: what its cursor says by COUNT_LISTED, found without the
  // shading loop. Counting laps compare them for every pixel. Default: not known.
  virtual std::optional<uint32_t> lights_listed(glm::uvec2 /*pixel*/, float /*depth*/) const { return {}; }
};

// One line of the registry.
struct AlgorithmEntry {
  AlgorithmInfo info;
  std::vector<ParameterInfo> parameters;
  // Further checks across parameters and against resolution; returns "" or what is wrong.
  std::function<std::string(const Parameters&, uint32_t width, uint32_t height)> check;
  std::function<std::unique_ptr<Algorithm>(const Parameters&)> create;
  // Seconds that a frame takes on two cores of a software device beyond preparation and the walk of a list of
  // a handful of lights for each pixel; none: nothing. For the estimate of a run, so a factor of two is near
  // enough. `lights` are all of the scene's.
  std::function<double(const Parameters&, uint32_t width, uint32_t height, uint32_t lights)> further_seconds;
};

// All algorithms, in the order in which tables show them. Only registry.cpp names them.
const std::vector<AlgorithmEntry>& algorithm_registry();
// Throws UsageError with the nearest known name; `where` begins the message.
const AlgorithmEntry& find_algorithm(const std::string& name, const std::string& where);

}  // namespace ml
