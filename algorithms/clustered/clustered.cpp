#include "algorithms/clustered/clustered.h"

#include <cstring>

#include "algorithms/clustered/cluster_lists.h"
#include "spirv/clustered_shade.h"
#include "spirv/clustered_shade_counting.h"

namespace ml {
namespace {

enum Slot : uint32_t { grid_slot, offsets_slot, indices_slot, duplicates_slot };

// As the light cursor reads it.
struct GridHeader {
  gpu_data::SliceMapping mapping;
  uint32_t tile, columns, slices;
};

template <typename Element>
void copy(std::span<const Element> from, std::span<std::byte> to) {
  if (!from.empty()) std::memcpy(to.data(), from.data(), from.size_bytes());
}

class Clustered final : public Algorithm {
 public:
  explicit Clustered(const Parameters& p) : duplicated_(p.choice("light_data") == "duplicated") {
    settings_.tile = static_cast<uint32_t>(p.integer("tile"));
    settings_.slices = static_cast<uint32_t>(p.integer("slices"));
    settings_.zmin = static_cast<float>(p.real("zmin"));
    settings_.zmax = static_cast<float>(p.real("zmax"));
    settings_.refinement = p.boolean("refinement");
  }

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    size_t entry_bytes = duplicated_ ? sizeof(gpu_data::LightCore) : sizeof(uint32_t);
    lists_.build(frame, settings_, memory.limit() / entry_bytes, spans);
    auto span = spans.span("upload");
    const GridHeader header{lists_.grid().mapping, settings_.tile, lists_.grid().columns, settings_.slices};
    copy(std::span(&header, 1), memory.map(grid_slot, sizeof header));
    copy(lists_.offsets(), memory.map(offsets_slot, lists_.offsets().size_bytes()));
    std::span<const uint32_t> indices = lists_.indices();
    if (duplicated_) {
      auto* lights = reinterpret_cast<gpu_data::LightCore*>(
          memory.map(duplicates_slot, indices.size() * entry_bytes).data());
      for (size_t i = 0; i < indices.size(); ++i) lights[i] = frame.lights.core[indices[i]];
      memory.map(indices_slot, 0);
    } else {
      copy(indices, memory.map(indices_slot, indices.size_bytes()));
      memory.map(duplicates_slot, 0);
    }
    counters_.in_frustum = lists_.lights_in_frustum();
    counters_.list_bytes = lists_.offsets().size_bytes() + indices.size() * entry_bytes;
  }

  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {"Grid", "Offsets", "Indices", "Duplicates"}; }
  ShadeShaders shade_shaders() const override { return {clustered_shade, clustered_shade_counting}; }
  std::vector<uint32_t> shade_constants() const override { return {duplicated_}; }

 private:
  bool duplicated_;
  ClusterSettings settings_;
  ClusterLists lists_;
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry clustered_entry() {
  AlgorithmEntry entry;
  entry.info.name = "clustered";
  entry.info.summary = "froxel lists, binned on the CPU";
  entry.info.paper = "Persson, Practical Clustered Shading, SIGGRAPH 2013";
  entry.info.cpu_stages = {"cull", "bin", "upload"};
  entry.info.gpu_stages = {"shade"};
  entry.info.shapes = {"omni", "spot", "capsule", "wedge", "box"};
  entry.parameters = {
      ParameterInfo::integer("tile", 24, 4, 1024, "side of a screen tile in pixels"),
      ParameterInfo::integer("slices", 16, 1, 256, "depth slices: one near slice and the rest exponential"),
      ParameterInfo::real("zmin", 5, 0.01, 1e6, "depth in metres at which the near slice ends"),
      ParameterInfo::real("zmax", 0, 0, 1e9,
                          "depth in metres at which the last slice ends; 0: the scene's far depth"),
      ParameterInfo::boolean("refinement", false, "narrow each row and slice of froxels to the light's ball"),
      ParameterInfo::choice(
          "light_data", "indexed", {"indexed", "duplicated"},
          "lists hold light indices, or copies of the light data (Tiled Light Trees, fig. 5)"),
  };
  entry.check = [](const Parameters& p, uint32_t width, uint32_t height) -> std::string {
    if (p.real("zmax") > 0 && p.real("zmax") <= p.real("zmin")) return "zmax must be greater than zmin";
    auto tiles = [&](uint32_t pixels) { return (pixels + p.integer("tile") - 1) / p.integer("tile"); };
    // Offsets of one buffer of the smallest range that Vulkan 1.3 devices have (2^27 bytes).
    int64_t froxels = tiles(width) * tiles(height) * p.integer("slices");
    if (froxels >= int64_t{1} << 25)
      return "tile and slices give " + std::to_string(froxels) + " froxels; at most 33554431 are possible";
    return "";
  };
  entry.create = [](const Parameters& parameters) { return std::make_unique<Clustered>(parameters); };
  return entry;
}

}  // namespace ml
