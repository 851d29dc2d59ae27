#include "algorithms/light_bvh/light_bvh.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "algorithms/froxels/binning.h"
#include "algorithms/light_bvh/packing.h"
#include "harness/base/error.h"
#include "spirv/light_bvh_forward.h"
#include "spirv/light_bvh_forward_counting.h"
#include "spirv/light_bvh_shade.h"
#include "spirv/light_bvh_shade_counting.h"

namespace ml {
namespace {

enum Slot : uint32_t { tree_slot, nodes_slot };

// One light in so many is inserted anew each frame.
constexpr uint32_t reinsertion_period = 64;

class LightBvh final : public Algorithm {
 public:
  explicit LightBvh(const Parameters& p)
      : tree_(static_cast<uint32_t>(p.integer("branching"))),
        rebuild_(p.choice("update") == "rebuild"),
        node_words_(p.choice("node_bytes") == "24" ? 6 : 8) {}

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    {
      auto span = spans.span("cull");
      find_visible(frame);
    }
    {
      auto span = spans.span("build");
      update(frame);
      packing_.build(tree_, visible_);
    }
    lights_ = static_cast<uint32_t>(frame.lights.count());
    auto span = spans.span("upload");
    const auto nodes = packing_.nodes();
    const size_t node_bytes = size_t{node_words_} * sizeof(uint32_t), bytes = nodes.size() * node_bytes;
    if (bytes > memory.limit())
      throw SystemError(fmt::format("light_bvh: the tree would take {} bytes, the device's buffer holds {}",
                                    bytes, memory.limit()));
    const auto count = static_cast<uint32_t>(nodes.size());
    std::memcpy(memory.map(tree_slot, sizeof count).data(), &count, sizeof count);
    std::byte* to = memory.map(nodes_slot, bytes).data();
    if (node_bytes != sizeof(PackedNode) && bytes > 0) std::memset(to, 0, bytes);
    for (size_t i = 0; i < nodes.size(); ++i) std::memcpy(to + i * node_bytes, &nodes[i], sizeof(PackedNode));
    counters_.list_bytes = bytes;
  }

  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {"Tree", "SphereNodes"}; }
  ShadeShaders shade_shaders() const override {
    return {light_bvh_shade, light_bvh_shade_counting, light_bvh_forward, light_bvh_forward_counting};
  }
  gpu::Constants shade_constants() const override { return {{"NODE_WORDS", node_words_}}; }
  // All lights of the frame, whether their leaves are visible or not.
  std::optional<uint32_t> lights_listed(glm::uvec2, float) const override { return lights_; }
  // A leaf is a light.
  LongestWalk longest_walk(const FrameInput&) const override { return {0, packing_.nodes().size()}; }

 private:
  void find_visible(const FrameInput& frame) {
    // One froxel: only the planes of the view count.
    const FroxelGrid grid = FroxelGrid::make(
        frame.view, std::max(frame.view.resolution.x, frame.view.resolution.y), 1, frame.view.near, 0);
    culled_.reserve(frame.lights.count());
    culled_.count =
        simd::cull(frame.lights, 0, frame.lights.count(), BoundsConstants(frame.view, grid), culled_);
    visible_.assign(frame.lights.count(), 0);
    for (size_t i = 0; i < culled_.count; ++i) visible_[culled_.index[i]] = 1;
    counters_.in_frustum = culled_.count;
  }

  // A lap through the frames begins with a fresh tree, so that every lap does the same work. A frame that is
  // prepared again is only refitted.
  void update(const FrameInput& frame) {
    if (rebuild_ || frame.step == Step::first) {
      tree_.build(frame.lights);
    } else {
      tree_.follow(frame.lights);
      if (frame.step == Step::next) tree_.reinsert(frame.index % reinsertion_period, reinsertion_period);
    }
  }

  SphereTree tree_;
  SpherePacking packing_;
  bool rebuild_;
  uint32_t node_words_;
  VisibleLights culled_;
  std::vector<uint8_t> visible_;
  uint32_t lights_ = 0;
  PrepareCounters counters_;
};

// Measured on canyon, arena and plane: nodes that a pixel looks at grow with the logarithm of the lights.
double walk_seconds(const Parameters& p, uint32_t width, uint32_t height, uint32_t lights) {
  constexpr double node = 0.5e-9, nodes_a_level = 5, refitted = 0.15e-6, rebuilt = 0.6e-6;
  const double nodes = nodes_a_level * std::log2(1.0 + lights);
  return width * node * height * nodes + lights * (p.choice("update") == "refit" ? refitted : rebuilt);
}

}  // namespace

AlgorithmEntry light_bvh_entry() {
  AlgorithmEntry entry;
  entry.info.name = "light_bvh";
  entry.info.summary = "one tree of spheres over all lights, walked by every pixel";
  entry.info.paper = "Mamacos, Simple Alternative to Clustered Shading for Thousands of Lights (blog post)";
  entry.info.cpu_stages = {"cull", "build", "upload"};
  entry.parameters = {
      ParameterInfo::integer("branching", 8, 2, 8, "most children of a node"),
      ParameterInfo::choice("update", "refit", {"refit", "rebuild"},
                            "moving lights: refit the tree, insert those that came and one of the others in "
                            "64 anew each frame, or build it afresh (surface area heuristic)"),
      ParameterInfo::choice("node_bytes", "24", {"24", "32"},
                            "bytes of a node: packed, or padded to two words of 16"),
  };
  entry.create = [](const Parameters& parameters) { return std::make_unique<LightBvh>(parameters); };
  entry.further_seconds = walk_seconds;
  return entry;
}

}  // namespace ml
